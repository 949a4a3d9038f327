#include "wheatstone/measures/wrong_spots.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// A colour as three coordinates.
using Place = std::array<float, 3>;

/// A picture's colours in a space in which those farther apart than 1 are told apart.
Image<Place> in_space(ImageView<const Rgb8> picture, ColourDistance distance) {
  constexpr float farthest_rgb = 60, farthest_oklab = 0.11f, reflected = 0.01f;
  const auto rgb = [](Rgb8 c) { return Place{c.r / farthest_rgb, c.g / farthest_rgb, c.b / farthest_rgb}; };
  const auto oklab = [](Rgb8 c) {
    const Oklab seen = oklab_from_linear(
        {linear_from_srgb(c.r) + reflected, linear_from_srgb(c.g) + reflected, linear_from_srgb(c.b) + reflected});
    return Place{seen.lightness / farthest_oklab, seen.a / farthest_oklab, seen.b / farthest_oklab};
  };
  Image<Place> places(picture.width(), picture.height());
  tbb::parallel_for(0, picture.height(), [&](int y) {
    if (distance == ColourDistance::rgb)
      std::ranges::transform(picture.row(y), places.row(y).begin(), rgb);
    else
      std::ranges::transform(picture.row(y), places.row(y).begin(), oklab);
  });
  return places;
}

bool is_near_in_colour(const Place& a, const Place& b) {
  const float x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
  constexpr float rounding = 1e-5f;
  return x * x + y * y + z * z <= 1 + rounding;
}

bool has_colour_near(const Image<Place>& photograph, const Place& colour, int x, int y) {
  if (is_near_in_colour(photograph(x, y), colour)) return true;
  const double radius_px = 4.0 * photograph.width() / 640;
  const int reach = static_cast<int>(radius_px);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, photograph.height() - 1); ++row) {
    const int away = row - y, half = static_cast<int>(std::sqrt(radius_px * radius_px - away * away));
    const int left = std::max(x - half, 0), right = std::min(x + half + 1, photograph.width());
    const auto about = photograph.row(row).subspan(left, right - left);
    if (std::ranges::any_of(about, [&](const Place& there) { return is_near_in_colour(there, colour); })) return true;
  }
  return false;
}

struct Count {
  double spots = 0, wrong = 0, pixels = 0;
};

Count count_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph, ColourDistance distance) {
  const Image<std::uint8_t> wrong = wrong_pixels(painted, photograph, distance);
  cv::Mat labels, facts, centres;
  const int components = cv::connectedComponentsWithStats(as_mat(wrong), labels, facts, centres);
  Count count{.pixels = static_cast<double>(painted.width()) * painted.height()};
  for (int i = 1; i < components; ++i) {  // 0 is what is not wrong
    constexpr int least_spot_px = 4;
    const int size = facts.at<int>(i, cv::CC_STAT_AREA);
    if (size < least_spot_px) continue;
    ++count.spots;
    count.wrong += size;
  }
  return count;
}

WrongSpots measure_of(const Count& count) {
  if (count.pixels == 0) return {};
  return {1e5 * count.spots / count.pixels, count.wrong / count.pixels};
}

}  // namespace

Image<std::uint8_t> wrong_pixels(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph,
                                 ColourDistance distance) {
  if (painted.width() != photograph.width() || painted.height() != photograph.height())
    throw Error(ErrorKind::bad_input,
                fmt::format("the painting is {}x{} pixels, expected the photograph's {}x{}", painted.width(),
                            painted.height(), photograph.width(), photograph.height()));
  const Image<Place> own = in_space(painted, distance), wanted = in_space(photograph, distance);
  Image<std::uint8_t> wrong(painted.width(), painted.height());
  tbb::parallel_for(0, painted.height(), [&](int y) {
    for (int x = 0; x < painted.width(); ++x) wrong(x, y) = has_colour_near(wanted, own(x, y), x, y) ? 0 : 255;
  });
  return wrong;
}

WrongSpots measure_wrong_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph,
                               ColourDistance distance) {
  return measure_of(count_spots(painted, photograph, distance));
}

WrongSpots measure_wrong_spots(const StereoPairView& painted, const StereoPairView& photographs,
                               ColourDistance distance) {
  const Count left = count_spots(painted.left, photographs.left, distance),
              right = count_spots(painted.right, photographs.right, distance);
  return measure_of({left.spots + right.spots, left.wrong + right.wrong, left.pixels + right.pixels});
}

}  // namespace wheatstone
