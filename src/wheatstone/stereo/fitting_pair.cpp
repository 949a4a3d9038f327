#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <cmath>

#include "wheatstone/error.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

void check_sizes(std::string_view name, PictureSize found, std::string_view owner, PictureSize expected) {
  if (found != expected)
    throw Error(ErrorKind::bad_input, fmt::format("{} is {}x{} pixels, expected {} {}x{}", name, found.width,
                                                  found.height, owner, expected.width, expected.height));
}

void check_fits(const StereoPairView& pair) {
  check_same_size("the right picture", pair.right, "the left one's", pair.left);
}

void check_fits(const StereoPairView& photographs, const StereoGeometryView& geometry) {
  if (photographs.left.empty()) throw Error(ErrorKind::bad_input, "the left picture has no pixels");
  const auto check = [&](const auto& image, std::string_view name) {
    check_same_size(name, image, "the photographs'", photographs.left);
  };
  check(geometry.left_disparity, "the left disparity");
  if (photographs.right.empty()) return check_has_no_unknowns(geometry.left_disparity);
  check_fits(photographs);
  check(geometry.right_disparity, "the right disparity");
  check(geometry.left_occlusion, "the left occlusion mask");
  check(geometry.right_occlusion, "the right occlusion mask");
  for (const ImageView<const float>& disparity : {geometry.left_disparity, geometry.right_disparity})
    check_has_no_unknowns(disparity);
}

void check_has_no_unknowns(ImageView<const float> disparity) {
  std::atomic<bool> has_unknowns = false;
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    int unknown = 0;  // without a way out of the loop, which would make it slow
    for (const float value : disparity.row(y)) unknown |= std::isfinite(value) ? 0 : 1;
    if (unknown != 0) has_unknowns = true;
  });
  if (has_unknowns) throw Error(ErrorKind::bad_input, "the disparity has unknown pixels, expected none");
}

}  // namespace wheatstone
