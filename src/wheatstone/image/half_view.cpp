#include "wheatstone/image/half_view.h"

#include <tbb/parallel_for.h>

namespace wheatstone {
namespace {

Rgb8 mean(Rgb8 a, Rgb8 b, Rgb8 c, Rgb8 d) {
  const auto channel = [&](std::uint8_t Rgb8::*m) {
    return static_cast<std::uint8_t>((a.*m + b.*m + c.*m + d.*m + 2) / 4);
  };
  return {channel(&Rgb8::r), channel(&Rgb8::g), channel(&Rgb8::b)};
}

}  // namespace

HalfView halved(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                ImageView<const std::uint8_t> seeds) {
  const int width = photograph.width() / HalfView::reduction, height = photograph.height() / HalfView::reduction;
  HalfView half{Image<Rgb8>(width, height), Image<float>(width, height), Image<std::uint8_t>(width, height)};
  tbb::parallel_for(0, height, [&](int y) {
    const auto upper = photograph.row(2 * y), lower = photograph.row(2 * y + 1);
    const auto upper_seeds = seeds.row(2 * y), lower_seeds = seeds.row(2 * y + 1);
    const auto near = disparity.row(2 * y);
    for (int x = 0; x < width; ++x) {
      const int left = 2 * x, right = left + 1;
      half.photograph(x, y) = mean(upper[left], upper[right], lower[left], lower[right]);
      half.disparity(x, y) = near[left] / HalfView::reduction;
      half.seeds(x, y) = upper_seeds[left] | upper_seeds[right] | lower_seeds[left] | lower_seeds[right];
    }
  });
  return half;
}

}  // namespace wheatstone
