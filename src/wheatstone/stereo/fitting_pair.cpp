#include <fmt/format.h>

#include <cmath>

#include "wheatstone/error.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

void check_fits(const StereoPair& photographs, const StereoGeometry& geometry) {
  const auto check = [&](const auto& image, std::string_view name) {
    if (!same_size(image, photographs.left))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{} is {}x{} pixels, expected the photographs' {}x{}", name, image.width(),
                              image.height(), photographs.left.width(), photographs.left.height()));
  };
  if (photographs.left.empty()) throw Error(ErrorKind::bad_input, "the left picture has no pixels");
  check(photographs.right, "the right picture");
  check(geometry.left_disparity, "the left disparity");
  check(geometry.right_disparity, "the right disparity");
  check(geometry.left_occlusion, "the left occlusion mask");
  check(geometry.right_occlusion, "the right occlusion mask");
  for (const Image<float>* disparity : {&geometry.left_disparity, &geometry.right_disparity})
    for (const float value : disparity->pixels())
      if (!std::isfinite(value)) throw Error(ErrorKind::bad_input, "the disparity has unknown pixels, expected none");
}

}  // namespace wheatstone
