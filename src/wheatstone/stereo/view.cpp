#include "wheatstone/stereo/view.h"

#include <algorithm>

namespace wheatstone {

std::vector<View> scene_from_left(const StereoPairView& pair, const StereoGeometryView& geometry) {
  return {{pair.left, geometry.left_disparity, {}, left_eye},
          {pair.right, geometry.right_disparity, geometry.right_occlusion, right_eye}};
}

std::vector<View> scene_from_centre(const CentralView& centre, const StereoPairView& pair,
                                    const StereoGeometryView& geometry) {
  return {{centre.picture, centre.disparity, {}, central_view},
          {pair.left, geometry.left_disparity, centre.left_only, left_eye},
          {pair.right, geometry.right_disparity, centre.right_only, right_eye}};
}

float disparity_at(const View& view, float x, float y) {
  const int column = std::clamp(static_cast<int>(view.frame.column(x)), 0, view.disparity.width() - 1);
  const int row = std::clamp(static_cast<int>(view.frame.row(y)), 0, view.disparity.height() - 1);
  return view.disparity(column, row) * static_cast<float>(view.frame.scale);
}

}  // namespace wheatstone
