#include "wheatstone/motion/film_frame.h"

#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/stereo/fitting_pair.h"

namespace wheatstone {

void check_fits(std::span<const View> views) {
  if (views.empty() || views[0].colour.empty())
    throw Error(ErrorKind::bad_input, "the scene has no picture, or one with no pixels");
  const ImageView<const Rgb8> reference = views[0].colour;
  for (const View& view : views) {
    if (view.frame.scale < 1 || (view.frame.scale > 1 && (!view.continued || view.wanted.empty())))
      throw Error(ErrorKind::bad_input, "a view that an eye sees is reduced");
    const auto check = [&](const auto& image, std::string_view name) {
      check_sizes(name, {image.width(), image.height()}, view.frame.scale == 1 ? "the reference view's" : "reduced to",
                  {reference.width() / view.frame.scale, reference.height() / view.frame.scale});
    };
    check(view.colour, "a view's picture");
    check(view.disparity, "a view's disparity");
    if (!view.wanted.empty()) check(view.wanted, "a view's mask");
    check_has_no_unknowns(view.disparity);
  }
}

void check_fits(const FlowPair& flow, std::span<const View> views) {
  for (const Flow* direction : {&flow.forward, &flow.backward})
    for (const Image<float>* component : {&direction->x, &direction->y})
      if (views.empty() || !same_size(*component, views[0].colour))
        throw Error(ErrorKind::bad_input, "the flow does not have the size of the reference view");
}

}  // namespace wheatstone
