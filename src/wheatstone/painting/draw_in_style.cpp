#include "wheatstone/painting/draw_in_style_internal.h"
#include "wheatstone/painting/relief.h"

namespace wheatstone {
namespace {

/// Height of the paint's ridges, for a picture 640 pixels wide.
constexpr float relief_depth_px = 1.1f;

}  // namespace

DrawnView draw_in_style(ImageView<const Rgb8> photograph, const Painting& painting, float view, const Style& style) {
  DrawOptions over;
  if (style.background == Background::photograph) over.background = photograph;
  DrawnView drawn = draw(painting, view, over);
  if (style.texture)
    light_relief(relief_of(painting, view), relief_depth_px * style_scale(style, painting.width), drawn.picture);
  return drawn;
}

}  // namespace wheatstone
