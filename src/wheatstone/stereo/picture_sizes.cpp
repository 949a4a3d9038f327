#include "wheatstone/stereo/picture_sizes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {

bool is_large(PictureSize size) { return static_cast<double>(size.width) * size.height > 8e6; }

PictureSize reduced_size(PictureSize whole, int longest_px) {
  const int longer = std::max(whole.width, whole.height);
  if (longer <= longest_px) return whole;
  const double scale = static_cast<double>(longest_px) / longer;
  const auto side = [&](int pixels) { return std::max(static_cast<int>(std::lround(pixels * scale)), 1); };
  return {side(whole.width), side(whole.height)};
}

Image<Rgb8> reduced(ImageView<const Rgb8> picture, PictureSize size) {
  Image<Rgb8> small(size.width, size.height);
  cv::Mat target = as_mat(small);
  cv::resize(as_mat(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  return small;
}

namespace {

Image<Rgb8> part_of(const Image<Rgb8>& picture, int left, int top, int width, int height) {
  Image<Rgb8> part(width, height);
  for (int y = 0; y < height; ++y)
    std::ranges::copy(picture.row(top + y).subspan(static_cast<std::size_t>(left), static_cast<std::size_t>(width)),
                      part.row(y).begin());
  return part;
}

std::vector<double> mean_of_rows(const Image<Rgb8>& picture) {
  std::vector<double> means;
  for (int y = 0; y < picture.height(); ++y) {
    double sum = 0;
    for (const Rgb8 pixel : picture.row(y)) sum += pixel.r + 2 * pixel.g + pixel.b;
    means.push_back(sum / (4. * picture.width()));
  }
  return means;
}

/// The row of the taller picture at which the other's first row lies.
int first_common_row(const Image<Rgb8>& taller, const Image<Rgb8>& lower) {
  const std::vector<double> of_taller = mean_of_rows(taller), of_lower = mean_of_rows(lower);
  const int rows = lower.height(), most = taller.height() - rows;
  int best = most / 2;
  double least = std::numeric_limits<double>::infinity();
  for (int from_middle = 0; from_middle <= most; ++from_middle) {
    // The middle first: where rows tell nothing, it is as good as any.
    const int first = most / 2 + (from_middle % 2 == 1 ? 1 : -1) * (from_middle + 1) / 2;
    if (first < 0 || first > most) continue;
    double difference = 0;
    for (int y = 0; y < rows; ++y)
      difference += std::abs(of_taller[static_cast<std::size_t>(first) + static_cast<std::size_t>(y)] -
                             of_lower[static_cast<std::size_t>(y)]);
    if (difference < least) {
      least = difference;
      best = first;
    }
  }
  return best;
}

}  // namespace

bool differ_by_few(PictureSize a, PictureSize b) {
  constexpr int fewest = 50;
  const auto few = [](int one, int other) { return fewest * std::abs(one - other) <= std::max(one, other); };
  return a != b && few(a.width, b.width) && few(a.height, b.height);
}

void frame_common_part(StereoPair& pair) {
  const int width = std::min(pair.left.width(), pair.right.width());
  const int height = std::min(pair.left.height(), pair.right.height());
  const bool left_is_taller = pair.left.height() > height;
  const Image<Rgb8>& taller = left_is_taller ? pair.left : pair.right;
  const Image<Rgb8>& lower = left_is_taller ? pair.right : pair.left;
  const int top = taller.height() > height ? first_common_row(taller, lower) : 0;
  for (Image<Rgb8>* const picture : {&pair.left, &pair.right})
    *picture = part_of(*picture, (picture->width() - width) / 2, picture->height() > height ? top : 0, width, height);
}

}  // namespace wheatstone
