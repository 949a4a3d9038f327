#include "wheatstone/measures/wrong_spots.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

bool differ(const Rgb8& a, const Rgb8& b) {
  constexpr int most = static_cast<int>(unlike_colours);
  const int red = a.r - b.r, green = a.g - b.g, blue = a.b - b.b;
  return red * red + green * green + blue * blue > most * most;
}

/// The pixels of a disc, the nearest first: nearly always one of the first ones answers.
std::vector<cv::Point> disc(double radius_px) {
  const int reach = static_cast<int>(radius_px);
  std::vector<cv::Point> pixels;
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x)
      if (x * x + y * y <= radius_px * radius_px) pixels.emplace_back(x, y);
  std::ranges::stable_sort(pixels, {}, [](const cv::Point& p) { return p.dot(p); });
  return pixels;
}

struct Count {
  double spots = 0, wrong = 0, pixels = 0;
};

Count count_spots(ImageView<const Rgb8> painted, ImageView<const Rgb8> photograph) {
  constexpr int least_px = 4;
  const Image<std::uint8_t> wrong = wrong_pixels(painted, photograph);
  cv::Mat labels, facts, centres;
  const int components = cv::connectedComponentsWithStats(as_mat(wrong), labels, facts, centres);
  Count count{.pixels = static_cast<double>(painted.width()) * painted.height()};
  for (int i = 1; i < components; ++i) {  // 0 is what is not wrong
    const int size = facts.at<int>(i, cv::CC_STAT_AREA);
    if (size < least_px) continue;
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
  const std::vector<cv::Point> near = disc(4.0 * painted.width() / 640);
  Image<std::uint8_t> wrong(painted.width(), painted.height());
  tbb::parallel_for(0, painted.height(), [&](int y) {
    for (int x = 0; x < painted.width(); ++x) {
      const Rgb8 colour = painted(x, y);
      wrong(x, y) = std::ranges::all_of(near,
                                        [&](const cv::Point& p) {
                                          return !photograph.contains(x + p.x, y + p.y) ||
                                                 differ(colour, photograph(x + p.x, y + p.y));
                                        })
                        ? 255
                        : 0;
    }
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
