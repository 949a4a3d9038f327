#include "wheatstone/motion/fitting_scene.h"

#include <cmath>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

void check_fits(std::span<const SceneView> views) {
  if (views.empty() || views[0].picture.empty())
    throw Error(ErrorKind::bad_input, "the scene has no picture, or one with no pixels");
  const ImageView<const Rgb8> reference = views[0].picture;
  const auto check = [&](const auto& image, std::string_view name) {
    check_same_size(name, image, "the reference view's", reference);
  };
  for (const SceneView& view : views) {
    check(view.picture, "a view's picture");
    check(view.disparity, "a view's disparity");
    if (!view.only_here.empty()) check(view.only_here, "a view's mask");
    for (int y = 0; y < view.disparity.height(); ++y) {
      int unknown = 0;  // without a way out of the loop, which would make it slow
      for (const float value : view.disparity.row(y)) unknown |= std::isfinite(value) ? 0 : 1;
      if (unknown != 0) throw Error(ErrorKind::bad_input, "the disparity has unknown pixels, expected none");
    }
  }
}

void check_fits(const FlowPair& flow, std::span<const SceneView> views) {
  for (const Flow* direction : {&flow.forward, &flow.backward})
    for (const Image<float>* component : {&direction->x, &direction->y})
      if (views.empty() || !same_size(*component, views[0].picture))
        throw Error(ErrorKind::bad_input, "the flow does not have the size of the reference view");
}

}  // namespace wheatstone
