#include "wheatstone/app/corrected_depth.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/motion/expected_disparity.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {

Image<float> read_frame_disparity(const std::filesystem::path& file, PictureSize frame) {
  Image<float> disparity = read_disparity(file);
  if (disparity.width() != frame.width || disparity.height() != frame.height)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {}x{} pixels, expected {}x{} as an eye of the film", file.string(),
                            disparity.width(), disparity.height(), frame.width, frame.height));
  return disparity;
}

namespace {

/// Where disparities made by hand differ from what was found, in the found picture's pixels; NaN elsewhere.
Image<float> corrections_among(const Image<float>& by_hand, const Image<float>& found) {
  constexpr float one_surface_px = 1;  // two ways to find the same disparity differ by less
  const auto reduction = static_cast<int>(std::lround(static_cast<double>(by_hand.width()) / found.width()));
  const auto scale = static_cast<float>(reduction);
  Image<float> corrections(found.width(), found.height(), std::numeric_limits<float>::quiet_NaN());
  for (int y = 0; y < found.height(); ++y)
    for (int x = 0; x < found.width(); ++x) {
      const float disparity =
          by_hand(std::min(x * reduction, by_hand.width() - 1), std::min(y * reduction, by_hand.height() - 1));
      if (std::abs(disparity - found(x, y) * scale) > one_surface_px) corrections(x, y) = disparity / scale;
    }
  return corrections;
}

}  // namespace

std::optional<StereoGeometry> corrected(const Image<float>& found, const std::filesystem::path& by_hand,
                                        PictureSize frame, const Flow& to_before, Image<float>& corrections) {
  if (!by_hand.empty()) {
    corrections = corrections_among(read_frame_disparity(by_hand, frame), found);
  } else if (!corrections.empty()) {
    corrections = expected_disparity(corrections, to_before, found.width(), found.height());
  }
  if (corrections.empty()) return {};
  Image<float> left = found;
  for (int y = 0; y < left.height(); ++y)
    for (int x = 0; x < left.width(); ++x)
      if (std::isfinite(corrections(x, y))) left(x, y) = corrections(x, y);
  return geometry_from_left(std::move(left));
}

}  // namespace wheatstone
