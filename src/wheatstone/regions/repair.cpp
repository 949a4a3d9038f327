#include "wheatstone/regions/repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <opencv2/imgproc.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/regions/colour_palette_internal.h"
#include "wheatstone/regions/outline_internal.h"
#include "wheatstone/regions/region_map_internal.h"

namespace wheatstone {
namespace {

/// Colours this near one another, as RGB distance, may stand for one another: less than what is seen as wrong, because
/// regions have the mean of their pixels and outlines are smooth.
constexpr int alike = 45;

/// Of the views in which marks may be drawn. They are few, since files tell ranges apart.
constexpr std::array shares_of_range{0.5f, 0.8f, 1.1f, 1.4f};

std::vector<Rgb8> colours_of(const RegionPainting& painting) {
  std::set<std::tuple<int, int, int>> colours;
  for (const RegionMark& mark : painting.marks) colours.emplace(mark.colour.r, mark.colour.g, mark.colour.b);
  std::vector<Rgb8> palette;
  for (const auto& [r, g, b] : colours)
    palette.push_back({static_cast<std::uint8_t>(r), static_cast<std::uint8_t>(g), static_cast<std::uint8_t>(b)});
  return palette;
}

/// A pixel of a spot, and its colour.
struct SpotPixel {
  int x, y;
  Rgb8 colour;
};

/// The pixel whose colour is nearest to the mean of all.
const SpotPixel& most_typical(const std::vector<SpotPixel>& pixels) {
  const int count = static_cast<int>(pixels.size());
  int red = 0, green = 0, blue = 0;
  for (const SpotPixel& pixel : pixels) {
    red += pixel.colour.r;
    green += pixel.colour.g;
    blue += pixel.colour.b;
  }
  const auto level = [&](int sum) { return static_cast<std::uint8_t>(sum / count); };
  const Rgb8 mean{level(red), level(green), level(blue)};
  return *std::ranges::min_element(pixels, {}, [&](const SpotPixel& p) { return squared_distance(p.colour, mean); });
}

/// Cuts a spot by colour: pixels like a typical one, then those like a typical one of the rest, and so on. Returns the
/// first label that is still free.
std::int32_t label_colours(std::vector<SpotPixel> rest, std::int32_t label, Image<std::int32_t>& labels) {
  while (!rest.empty()) {
    const Rgb8 colour = most_typical(rest).colour;
    std::vector<SpotPixel> others;
    for (const SpotPixel& pixel : rest) {
      if (squared_distance(pixel.colour, colour) > alike * alike)
        others.push_back(pixel);
      else
        labels(pixel.x, pixel.y) = label;
    }
    ++label;
    rest = std::move(others);
  }
  return label;
}

/// The pixels of the spots, grown by two so that smooth outlines lie around them, by spot and colour; −1 elsewhere.
Image<std::int32_t> label_places(const RepairTarget& target) {
  cv::Mat grown, numbers;
  cv::dilate(as_mat(target.places), grown, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  const int spots = cv::connectedComponents(grown, numbers);
  std::vector<std::vector<SpotPixel>> pixels(static_cast<std::size_t>(spots));
  for (int y = 0; y < numbers.rows; ++y)
    for (int x = 0; x < numbers.cols; ++x)
      if (const int spot = numbers.at<int>(y, x); spot > 0)  // 0 is what is not wrong
        pixels[static_cast<std::size_t>(spot)].push_back({x, y, target.picture(x, y)});
  Image<std::int32_t> labels(numbers.cols, numbers.rows, -1);
  std::int32_t label = 0;
  for (std::vector<SpotPixel>& spot : pixels) label = label_colours(std::move(spot), label, labels);
  return labels;
}

/// The palette, and the colours of the places that it lacks, the largest first, as long as it may grow.
void add_missing_colours(std::vector<RegionMeans> places, std::size_t most_colours, std::vector<Rgb8>& palette) {
  std::ranges::stable_sort(places, std::greater{}, &RegionMeans::area);
  for (const RegionMeans& place : places) {
    if (palette.size() >= most_colours) return;
    const Rgb8 mean = mean_colour(place);
    if (std::ranges::none_of(palette, [&](Rgb8 c) { return squared_distance(c, mean) <= alike * alike; }))
      palette.push_back(mean);
  }
}

}  // namespace

void repair(const RepairTarget& target, const Style& style, RegionPainting& painting) {
  if (painting.marks.empty()) return;
  const RegionMap regions = connected_regions(label_places(target), target.disparity, target.depth_threshold_px);
  const std::vector<RegionMeans> means = means_of(regions, target.picture, target.disparity);
  std::vector<Rgb8> palette = colours_of(painting);
  add_missing_colours(means, static_cast<std::size_t>(style.colours), palette);
  const std::size_t first = painting.marks.size(), first_point = painting.points.size();
  add_outlines(regions, target.disparity, target.view, {.depth_threshold_px = target.depth_threshold_px}, painting);
  for (std::size_t i = first_point; i < painting.points.size(); ++i)
    painting.points[i].x = x_in_view(painting.points[i], target.view, target.reference_view);
  for (std::size_t i = 0; i < means.size(); ++i) {
    RegionMark& mark = painting.marks[first + i];
    mark.colour = palette[nearest_colour(palette, mean_colour(means[i]))];
    mark.disparity = static_cast<float>(means[i].disparity);
    mark.reference_view = target.reference_view;
    mark.views = part_of_range(target, shares_of_range[i % shares_of_range.size()]);
  }
  std::erase_if(painting.marks, [](const RegionMark& mark) { return mark.ring_count == 0; });
}

}  // namespace wheatstone
