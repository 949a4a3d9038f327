#include "wheatstone/painting/posterise.h"

#include <tbb/parallel_for.h>

#include <cmath>

#include "wheatstone/painting/colour_palette_internal.h"
#include "wheatstone/painting/outline_internal.h"
#include "wheatstone/painting/plan_polygons_internal.h"

namespace wheatstone {
namespace {

/// Areas smaller than this, for a picture 640 pixels wide, are joined to their neighbours.
constexpr float least_area_px = 40;

Image<std::int32_t> label_colours(ImageView<const Rgb8> picture, ImageView<const std::uint8_t> mask,
                                  const std::vector<Rgb8>& palette) {
  Image<std::int32_t> labels(picture.width(), picture.height(), -1);
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x)
      if (mask.empty() || mask(x, y) != 0)
        labels(x, y) = static_cast<std::int32_t>(nearest_colour(palette, picture(x, y)));
  });
  return labels;
}

Rgb8 mean_colour(const RegionMeans& means) {
  const auto level = [](double value) { return static_cast<std::uint8_t>(std::lround(value)); };
  return {level(means.red), level(means.green), level(means.blue)};
}

void cut_colours(const ViewToCut& view, const Style& style, PolygonPainting& painting) {
  const Image<Rgb8> picture = without_grain(view.photograph, view.scale);
  const std::vector<Rgb8> palette =
      find_palette(without_grain(view.colours_from, view.scale), style.colours, view.seed);
  RegionMap regions =
      connected_regions(label_colours(picture, view.mask, palette), view.disparity, view.depth_threshold_px);
  const auto least_area = static_cast<std::int64_t>(least_area_px * view.scale * view.scale);
  regions = without_small_regions(std::move(regions), picture, view.disparity, view.depth_threshold_px, least_area);
  const std::size_t first = painting.marks.size();
  add_outlines(regions, view.disparity, view.view, {.depth_threshold_px = view.depth_threshold_px}, painting);
  const std::vector<RegionMeans> means = means_of(regions, picture, view.disparity);
  for (std::size_t i = 0; i < means.size(); ++i) {
    PolygonMark& mark = painting.marks[first + i];
    mark.colour = palette[nearest_colour(palette, mean_colour(means[i]))];
    mark.disparity = static_cast<float>(means[i].disparity);
    mark.views = view.views;
  }
}

}  // namespace

PolygonPainting plan_posterised(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style) {
  return plan_polygons(photographs, geometry, style, cut_colours);
}

}  // namespace wheatstone
