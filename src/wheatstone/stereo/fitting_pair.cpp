#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/error.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

void check_sizes(std::string_view name, ImageSize found, std::string_view owner, ImageSize expected) {
  if (found != expected)
    throw Error(ErrorKind::bad_input, fmt::format("{} is {}x{} pixels, expected {} {}x{}", name, found.width,
                                                  found.height, owner, expected.width, expected.height));
}

void check_fits(const StereoPairView& pair) {
  check_same_size("the right picture", pair.right, "the left one's", pair.left);
}

void check_fits(const StereoPairView& photographs, const StereoGeometryView& geometry) {
  if (photographs.left.empty()) throw Error(ErrorKind::bad_input, "the left picture has no pixels");
  check_fits(photographs);
  const auto check = [&](const auto& image, std::string_view name) {
    check_same_size(name, image, "the photographs'", photographs.left);
  };
  check(geometry.left_disparity, "the left disparity");
  check(geometry.right_disparity, "the right disparity");
  check(geometry.left_occlusion, "the left occlusion mask");
  check(geometry.right_occlusion, "the right occlusion mask");
  for (const ImageView<const float>& disparity : {geometry.left_disparity, geometry.right_disparity})
    for (int y = 0; y < disparity.height(); ++y)
      if (!std::ranges::all_of(disparity.row(y), [](float value) { return std::isfinite(value); }))
        throw Error(ErrorKind::bad_input, "the disparity has unknown pixels, expected none");
}

}  // namespace wheatstone
