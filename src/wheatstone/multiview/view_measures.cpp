#include "wheatstone/multiview/view_measures.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

namespace wheatstone {
namespace {

constexpr int spot_radius = 4;         // of what a lone splat covers
constexpr int surroundings = 9;        // that must be dark around it
constexpr int search = 3;              // how far away its counterpart may be
constexpr int bright = 48, dark = 12;  // brightest channel

int brightness(Rgb8 pixel) { return std::max({pixel.r, pixel.g, pixel.b}); }

struct Point {
  double x = 0, y = 0;
};

/// Centroid of the light around a pixel.
std::optional<Point> centroid(ImageView<const Rgb8> picture, int x, int y, int radius) {
  double sum = 0;
  Point at;
  for (int row = std::max(y - radius, 0); row <= std::min(y + radius, picture.height() - 1); ++row)
    for (int column = std::max(x - radius, 0); column <= std::min(x + radius, picture.width() - 1); ++column) {
      const double weight = brightness(picture(column, row));
      sum += weight;
      at.x += weight * column;
      at.y += weight * row;
    }
  if (sum < bright) return std::nullopt;
  return Point{at.x / sum, at.y / sum};
}

/// The brightest of its neighbours, with nothing but darkness farther around.
bool stands_alone(ImageView<const Rgb8> picture, int x, int y) {
  const int here = brightness(picture(x, y));
  if (here < bright) return false;
  for (int dy = -surroundings; dy <= surroundings; ++dy)
    for (int dx = -surroundings; dx <= surroundings; ++dx) {
      const int there = brightness(picture(x + dx, y + dy));
      const bool near = std::max(std::abs(dx), std::abs(dy)) <= spot_radius;
      if (!near && there > dark) return false;
      // Of two that are equally bright the upper left one counts.
      const bool later = dy > 0 || (dy == 0 && dx > 0);
      if (there > here || (there == here && !later && (dx != 0 || dy != 0))) return false;
    }
  return true;
}

void compare_spots(ImageView<const Rgb8> view, ImageView<const Rgb8> reference, ViewMeasures& measures) {
  for (int y = surroundings; y + surroundings < reference.height(); ++y)
    for (int x = surroundings; x + surroundings < reference.width(); ++x) {
      if (!stands_alone(reference, x, y)) continue;
      ++measures.isolated_splats;
      const std::optional<Point> expected = centroid(reference, x, y, spot_radius + search);
      const std::optional<Point> found = centroid(view, x, y, spot_radius + search);
      if (!found || std::hypot(found->x - expected->x, found->y - expected->y) > search) {
        ++measures.lost_splats;
        continue;
      }
      measures.largest_position_error_px =
          std::max(measures.largest_position_error_px, std::hypot(found->x - expected->x, found->y - expected->y));
    }
}

}  // namespace

ViewMeasures measure_view(ImageView<const Rgb8> view, ImageView<const Rgb8> reference,
                          const ViewMeasuresOptions& options) {
  ViewMeasures measures;
  double squares = 0;
  std::size_t differing = 0;
  for (int y = 0; y < view.height(); ++y)
    for (int x = 0; x < view.width(); ++x) {
      const Rgb8 a = view(x, y);
      const Rgb8 b = reference(x, y);
      const int differences[] = {std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)};
      for (const int difference : differences) squares += difference * difference;
      const int largest = *std::ranges::max_element(differences);
      differing += largest > 0;
      measures.differing_pixels += largest > options.noticeable;
    }
  const double pixels = static_cast<double>(view.width()) * view.height();
  measures.differing_share = static_cast<double>(differing) / pixels;
  measures.psnr_db =
      squares > 0 ? 10 * std::log10(255. * 255. * 3 * pixels / squares) : std::numeric_limits<double>::infinity();
  compare_spots(view, reference, measures);
  return measures;
}

}  // namespace wheatstone
