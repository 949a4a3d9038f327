#include "wheatstone/measures/film_measures.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {

WarpError measure_warp_error(ImageView<const Rgb8> first, ImageView<const Rgb8> second, const Flow& forward,
                             ImageView<const std::uint8_t> mask) {
  if (!same_size(first, second) || !same_size(first, mask) || !same_size(first, forward.x) ||
      !same_size(first, forward.y))
    throw Error(ErrorKind::bad_input, "frames, flow and mask of different sizes, expected one size");
  double sum = 0;
  std::int64_t compared = 0;
  for (int y = 0; y < first.height(); ++y) {
    for (int x = 0; x < first.width(); ++x) {
      const float there_x = static_cast<float>(x) + 0.5f + forward.x(x, y);
      const float there_y = static_cast<float>(y) + 0.5f + forward.y(x, y);
      if (mask(x, y) == 0 || !std::isfinite(there_x + there_y)) continue;
      const Rgb8 here = first(x, y);
      const SampledColour there = sample(second, there_x, there_y);
      const double r = there.r - here.r, g = there.g - here.g, b = there.b - here.b;
      sum += r * r + g * g + b * b;
      ++compared;
    }
  }
  if (compared == 0) return {};
  constexpr double channels = 3, white_square = 255.0 * 255.0;
  const auto pixels = static_cast<double>(first.width()) * first.height();
  return {sum / (channels * white_square * static_cast<double>(compared)), static_cast<double>(compared) / pixels};
}

FramePair relate_frames(ImageView<const Rgb8> first, ImageView<const Rgb8> second) {
  if (find_cut(first, second).cut) return {.cut = true};
  FlowPair flow = estimate_flow(first, second);
  Image<std::uint8_t> mask = confirmed(flow.forward, flow.backward);
  return {std::move(flow.forward), std::move(mask), false};
}

bool tells_cut(const FlowPair& known) {
  return std::ranges::all_of(known.forward.x.pixels(), [](float v) { return std::isnan(v); });
}

FramePair relate_frames(FlowPair truth) {
  if (tells_cut(truth)) return {.cut = true};
  Image<std::uint8_t> mask = confirmed(truth.forward, truth.backward);
  return {std::move(truth.forward), std::move(mask), false};
}

std::optional<WarpError> TemporalError::add(ImageView<const Rgb8> first, ImageView<const Rgb8> second,
                                            const FramePair& pair) {
  if (pair.cut) return {};
  const WarpError error = measure_warp_error(first, second, pair.forward, pair.mask);
  if (error.compared_share == 0) return {};
  sum_ += error.error;
  compared_ += error.compared_share;
  ++pairs_;
  return error;
}

}  // namespace wheatstone
