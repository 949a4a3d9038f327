#include "wheatstone/motion/steady_picture.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace wheatstone {
namespace {

SampledColour exactly(Rgb8 c) { return {static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)}; }

/// The picture before, as it lies in this frame. Cubic: bilinearly it would blur from frame to frame.
Image<SampledColour> carried(const Image<SampledColour>& before, const Flow& backward,
                             ImageView<const std::uint8_t> known) {
  Image<float> from_x(before.width(), before.height()), from_y(before.width(), before.height());
  tbb::parallel_for(0, before.height(), [&](int y) {
    for (int x = 0; x < before.width(); ++x) {
      const bool use = known(x, y) != 0;
      from_x(x, y) = static_cast<float>(x) + (use ? backward.x(x, y) : 0);
      from_y(x, y) = static_cast<float>(y) + (use ? backward.y(x, y) : 0);
    }
  });
  Image<SampledColour> now(before.width(), before.height());
  const auto matrix = [](const Image<SampledColour>& image) {
    return cv::Mat(image.height(), image.width(), CV_32FC3, const_cast<SampledColour*>(image.pixels().data()));
  };
  const cv::Mat map_x(from_x.height(), from_x.width(), CV_32FC1, from_x.pixels().data());
  const cv::Mat map_y(from_y.height(), from_y.width(), CV_32FC1, from_y.pixels().data());
  cv::Mat to = matrix(now);
  cv::remap(matrix(before), to, map_x, map_y, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
  return now;
}

}  // namespace

SteadyPicture begin_steady(ImageView<const Rgb8> frame) {
  SteadyPicture picture{Image<SampledColour>(frame.width(), frame.height()),
                        Image<std::uint8_t>(frame.width(), frame.height(), 1)};
  for (int y = 0; y < frame.height(); ++y)
    std::ranges::transform(frame.row(y), picture.colours.row(y).begin(), exactly);
  return picture;
}

void steady(ImageView<const Rgb8> frame, const Flow& backward, ImageView<const std::uint8_t> known,
            SteadyPicture& picture) {
  constexpr int most_frames = 6;
  constexpr float unlike = 40;  // the largest difference of a channel from which on it is another thing
  const Image<SampledColour> before = carried(picture.colours, backward, known);
  SteadyPicture next{Image<SampledColour>(frame.width(), frame.height()),
                     Image<std::uint8_t>(frame.width(), frame.height(), 1)};
  tbb::parallel_for(0, frame.height(), [&](int y) {
    for (int x = 0; x < frame.width(); ++x) {
      SampledColour& colour = next.colours(x, y);
      colour = exactly(frame(x, y));
      if (known(x, y) == 0) continue;
      const SampledColour old = before(x, y);
      const float difference =
          std::max({std::abs(colour.r - old.r), std::abs(colour.g - old.g), std::abs(colour.b - old.b)}) / unlike;
      if (difference >= 1) continue;
      const int from_x = std::clamp(x + static_cast<int>(std::lround(backward.x(x, y))), 0, frame.width() - 1);
      const int from_y = std::clamp(y + static_cast<int>(std::lround(backward.y(x, y))), 0, frame.height() - 1);
      const int frames = std::min<int>(picture.frames(from_x, from_y), most_frames);
      const float share = (1 - difference * difference) * static_cast<float>(frames) / static_cast<float>(frames + 1);
      colour = {colour.r + share * (old.r - colour.r), colour.g + share * (old.g - colour.g),
                colour.b + share * (old.b - colour.b)};
      next.frames(x, y) = static_cast<std::uint8_t>(frames + 1);
    }
  });
  picture = std::move(next);
}

Rgb8 rounded(const SampledColour& colour) {
  const auto level = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
  return {level(colour.r), level(colour.g), level(colour.b)};
}

Image<Rgb8> rounded(const Image<SampledColour>& colours) {
  Image<Rgb8> result(colours.width(), colours.height());
  std::ranges::transform(colours.pixels(), result.pixels().begin(),
                         [](const SampledColour& colour) { return rounded(colour); });
  return result;
}

}  // namespace wheatstone
