#include "wheatstone/measures/wrong_spots.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/error.h"
#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

bool is_near_in_colour(Rgb8 a, Rgb8 b) {
  constexpr int farthest = 60;  // of 441: nobody takes one colour for the other from there on
  const int red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
  return red * red + green * green + blue * blue <= farthest * farthest;
}

bool has_colour_near(ImageView<const Rgb8> photograph, Rgb8 colour, int x, int y) {
  if (is_near_in_colour(photograph(x, y), colour)) return true;
  const double radius_px = 4.0 * photograph.width() / 640;
  const int reach = static_cast<int>(radius_px);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, photograph.height() - 1); ++row) {
    const int away = row - y, half = static_cast<int>(std::sqrt(radius_px * radius_px - away * away));
    const int left = std::max(x - half, 0), right = std::min(x + half + 1, photograph.width());
    const auto about = photograph.row(row).subspan(left, right - left);
    if (std::ranges::any_of(about, [&](Rgb8 there) { return is_near_in_colour(there, colour); })) return true;
  }
  return false;
}

struct Count {
  double spots = 0, wrong = 0, pixels = 0;
};

Count count_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph) {
  const Image<std::uint8_t> wrong = wrong_pixels(painted, photograph);
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

Image<std::uint8_t> wrong_pixels(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph) {
  if (painted.width() != photograph.width() || painted.height() != photograph.height())
    throw Error(ErrorKind::bad_input,
                fmt::format("the painting is {}x{} pixels, expected the photograph's {}x{}", painted.width(),
                            painted.height(), photograph.width(), photograph.height()));
  Image<std::uint8_t> wrong(painted.width(), painted.height());
  tbb::parallel_for(0, painted.height(), [&](int y) {
    for (int x = 0; x < painted.width(); ++x) wrong(x, y) = has_colour_near(photograph, painted(x, y), x, y) ? 0 : 255;
  });
  return wrong;
}

WrongSpots measure_wrong_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph) {
  return measure_of(count_spots(painted, photograph));
}

WrongSpots measure_wrong_spots(const StereoPairView& painted, const StereoPairView& photographs) {
  const Count left = count_spots(painted.left, photographs.left), right = count_spots(painted.right, photographs.right);
  return measure_of({left.spots + right.spots, left.wrong + right.wrong, left.pixels + right.pixels});
}

}  // namespace wheatstone
