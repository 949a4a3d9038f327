#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/photograph/depth_beside_internal.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr int grey_tolerance = 8;  // of JPEGs

int colourfulness(Rgb8 colour) {
  const auto [least, most] = std::minmax({colour.r, colour.g, colour.b});
  return most - least;
}

/// Share of the pixels of a half, every fourth of every fourth row, of more colour than this.
double coloured_share(const Image<Rgb8>& both, int first_column, int tolerance) {
  constexpr int step = 4;
  int all = 0, coloured = 0;
  for (int y = 0; y < both.height(); y += step)
    for (int x = first_column; x < first_column + both.width() / 2; x += step) {
      ++all;
      coloured += colourfulness(both(x, y)) > tolerance ? 1 : 0;
    }
  return static_cast<double>(coloured) / std::max(all, 1);
}

/// How much a pixel of the green channel differs from its neighbours.
int steepness(const Image<Rgb8>& both, int x, int y) {
  return std::max(std::abs(both(x + 1, y).g - both(x - 1, y).g), std::abs(both(x, y + 1).g - both(x, y - 1).g));
}

/// Whether the right half has sharp edges where the left one has edges, too, and is smoother elsewhere: a grey copy of
/// the photograph has the same edges, but is as rough.
bool is_depth_of_left_half(const Image<Rgb8>& both) {
  const int width = both.width() / 2;
  constexpr int edge = 12;  // levels
  std::vector<int> photograph, depth;
  std::array<std::vector<int>, 2> near_edge;  // the photograph around edges of the depth, and elsewhere
  for (int y = 2; y + 2 < both.height(); y += 2)
    for (int x = 2; x + 2 < width; x += 2) {
      photograph.push_back(steepness(both, x, y));
      depth.push_back(steepness(both, x + width, y));
      int around = 0;
      for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) around = std::max(around, steepness(both, x + dx, y + dy));
      near_edge[depth.back() >= edge ? 0 : 1].push_back(around);
    }
  if (photograph.empty() || near_edge[0].empty() || near_edge[1].empty()) return false;
  const auto median = [](std::vector<int> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
  };
  const double rough_share = static_cast<double>(near_edge[0].size()) / static_cast<double>(depth.size());
  // Around edges of true depth a photograph is 1.3 (leaves before woven cloth) to 4 times as steep as elsewhere.
  constexpr double most_edges = 0.2, least_agreement = 1.25;
  return rough_share < most_edges && 2 * median(depth) <= median(photograph) &&
         median(near_edge[0]) >= least_agreement * median(near_edge[1]);
}

bool is_named_so(const fs::path& path) {
  std::string stem = path.stem().string();
  std::ranges::transform(stem, stem.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return stem == "rgbd" ||
         (stem.ends_with("rgbd") && std::isalnum(static_cast<unsigned char>(stem[stem.size() - 5])) == 0);
}

CarriedDepth cut(const Image<Rgb8>& both) {
  const int width = both.width() / 2;
  CarriedDepth read{Image<Rgb8>(width, both.height()), Image<float>(width, both.height()), DepthKind::inverse,
                    "its right half"};
  for (int y = 0; y < both.height(); ++y)
    for (int x = 0; x < width; ++x) {
      read.picture(x, y) = both(x, y);
      read.depth(x, y) = both(x + width, y).g;
    }
  return read;
}

}  // namespace

std::optional<CarriedDepth> find_depth_beside(const fs::path& path) {
  const Image<Rgb8> both = read_image(path);
  if (both.width() < 2 || both.width() % 2 != 0) return {};
  constexpr double few = 0.002, some = 0.02;
  const bool is_grey = coloured_share(both, both.width() / 2, grey_tolerance) <= few;
  if (!is_grey) return {};
  if (is_named_so(path)) return cut(both);
  if (coloured_share(both, 0, 3 * grey_tolerance) < some || !is_depth_of_left_half(both)) return {};
  return cut(both);
}

CarriedDepth read_depth_beside(const fs::path& path) {
  const Image<Rgb8> both = read_image(path);
  const int width = both.width() / 2;
  if (width < 1 || both.width() % 2 != 0)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {} pixels wide, expected a picture and its depth of one width beside each other",
                            path.string(), both.width()));
  for (int y = 0; y < both.height(); ++y)
    for (const Rgb8 level : both.row(y).subspan(static_cast<std::size_t>(width)))
      if (colourfulness(level) > grey_tolerance)
        throw Error(
            ErrorKind::bad_input,
            fmt::format("{}: its right half is in colour, expected the grey levels of a depth map", path.string()));
  return cut(both);
}

}  // namespace wheatstone
