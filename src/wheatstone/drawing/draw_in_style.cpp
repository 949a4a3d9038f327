#include "wheatstone/drawing/draw_in_style.h"

#include "wheatstone/drawing/relief.h"

namespace wheatstone {

DrawnView draw_in_style(ImageView<const Rgb8> photograph, const StrokePainting& painting, ViewPosition view,
                        const Style& style) {
  DrawOptions over;
  if (style.background == Background::photograph) over.background = photograph;
  DrawnView drawn = draw(painting, view, over);
  light_paint(painting, view, relief_for(style, painting.width), drawn.picture);
  return drawn;
}

}  // namespace wheatstone
