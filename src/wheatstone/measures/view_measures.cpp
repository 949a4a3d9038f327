#include "wheatstone/measures/view_measures.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "wheatstone/image/colour.h"
#include "wheatstone/percentile.h"

namespace wheatstone {
namespace {

constexpr int spot_radius = 4;         // of what a lone splat covers
constexpr int surroundings = 9;        // that must be dark around it
constexpr int search = 3;              // how far away its counterpart may be
constexpr int bright = 48, dark = 12;  // brightest channel
constexpr double least_share = 0.25;   // of a spot's light, to be found again
constexpr double floor_share = 0.05;   // of a spot's peak, below which its light is not told from its surroundings'

int brightness(Rgb8 pixel) { return std::max({pixel.r, pixel.g, pixel.b}); }

double light_of(Rgb8 pixel) {
  return 0.2126 * linear_from_srgb(pixel.r) + 0.7152 * linear_from_srgb(pixel.g) + 0.0722 * linear_from_srgb(pixel.b);
}

struct Pixel {
  int x = 0, y = 0;
};

/// Light of a spot, and where its centroid is.
struct Spot {
  double light = 0;
  double x = 0, y = 0;
};

/// Calls `visit(x, y)` for the pixels of a square of the picture.
template <class Visit>
void for_square(ImageView<const Rgb8> picture, Pixel centre, int radius, Visit visit) {
  for (int y = std::max(centre.y - radius, 0); y <= std::min(centre.y + radius, picture.height() - 1); ++y)
    for (int x = std::max(centre.x - radius, 0); x <= std::min(centre.x + radius, picture.width() - 1); ++x)
      visit(x, y);
}

/// The brightest of its neighbours, with nothing but darkness farther around.
bool stands_alone(ImageView<const Rgb8> picture, Pixel at) {
  const int here = brightness(picture(at.x, at.y));
  if (here < bright) return false;
  for (int dy = -surroundings; dy <= surroundings; ++dy)
    for (int dx = -surroundings; dx <= surroundings; ++dx) {
      const int there = brightness(picture(at.x + dx, at.y + dy));
      const bool near = std::max(std::abs(dx), std::abs(dy)) <= spot_radius;
      if (!near && there > dark) return false;
      // Of two that are equally bright the upper left one counts.
      const bool later = dy > 0 || (dy == 0 && dx > 0);
      if (there > here || (there == here && !later && (dx != 0 || dy != 0))) return false;
    }
  return true;
}

/// Median light around a spot: what a spot that happens to be there does not change.
double light_around(ImageView<const Rgb8> picture, Pixel at) {
  std::vector<double> ring;
  for_square(picture, at, surroundings, [&](int x, int y) {
    if (std::max(std::abs(x - at.x), std::abs(y - at.y)) > spot_radius + search)
      ring.push_back(light_of(picture(x, y)));
  });
  return percentile(std::move(ring), 0.5);
}

Pixel brightest_near(ImageView<const Rgb8> picture, Pixel at) {
  Pixel brightest = at;
  for_square(picture, at, search, [&](int x, int y) {
    if (light_of(picture(x, y)) > light_of(picture(brightest.x, brightest.y))) brightest = {x, y};
  });
  return brightest;
}

/// The spot around a pixel, of light above `floor`. The square follows its centroid, so that it is cut off nowhere.
Spot spot_at(ImageView<const Rgb8> picture, Pixel at, double floor) {
  Spot spot;
  for (int step = 0; step < search; ++step) {
    spot = {};
    for_square(picture, at, spot_radius + 1, [&](int x, int y) {
      const double weight = std::max(light_of(picture(x, y)) - floor, 0.);
      spot.light += weight;
      spot.x += weight * x;
      spot.y += weight * y;
    });
    if (spot.light <= 0) return {};
    spot.x /= spot.light;
    spot.y /= spot.light;
    const Pixel middle{static_cast<int>(std::lround(spot.x)), static_cast<int>(std::lround(spot.y))};
    if (middle.x == at.x && middle.y == at.y) break;
    at = middle;
  }
  return spot;
}

void compare_spot(ImageView<const Rgb8> view, ImageView<const Rgb8> reference, Pixel at, ViewMeasures& measures) {
  const double around = light_around(reference, at);
  // The same above either's surroundings, so that both are cut alike.
  const double above = floor_share * (light_of(reference(at.x, at.y)) - around);
  const Spot expected = spot_at(reference, at, around + above);
  const Spot found = spot_at(view, brightest_near(view, at), light_around(view, at) + above);
  const double error_px = std::hypot(found.x - expected.x, found.y - expected.y);
  if (found.light < least_share * expected.light || error_px > search) {
    ++measures.lost_splats;
  } else {
    measures.largest_position_error_px = std::max(measures.largest_position_error_px, error_px);
  }
}

void compare_spots(ImageView<const Rgb8> view, ImageView<const Rgb8> reference, ViewMeasures& measures) {
  for (int y = surroundings; y + surroundings < reference.height(); ++y)
    for (int x = surroundings; x + surroundings < reference.width(); ++x) {
      if (!stands_alone(reference, {x, y})) continue;
      ++measures.isolated_splats;
      compare_spot(view, reference, {x, y}, measures);
    }
}

}  // namespace

ViewMeasures measure_view(ImageView<const Rgb8> view, ImageView<const Rgb8> reference,
                          const ViewMeasuresOptions& options) {
  assert(same_size(view, reference) && !view.empty());
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
