#include "wheatstone/painting/draw_in_style_internal.h"

#include "wheatstone/painting/relief.h"

namespace wheatstone {

DrawnView draw_in_style(ImageView<const Rgb8> photograph, const Painting& painting, float view, const Style& style) {
  DrawOptions over;
  if (style.background == Background::photograph) over.background = photograph;
  DrawnView drawn = draw(painting, view, over);
  const Relief relief = relief_for(style, painting.width);
  if (relief.depth_px > 0) light_relief(relief_of(painting, view, relief.bristle_px), relief.depth_px, drawn.picture);
  return drawn;
}

}  // namespace wheatstone
