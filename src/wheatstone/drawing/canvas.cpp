#include "wheatstone/drawing/canvas.h"

#include <tbb/parallel_for.h>

namespace wheatstone {
namespace {

constexpr int padded(int width) { return width + 2 * Canvas::widest_vector; }

}  // namespace

Canvas::Canvas(int width_px, int height_px, Rgb8 colour)
    : width(width_px),
      height(height_px),
      red(padded(width), height, colour.r),
      green(padded(width), height, colour.g),
      blue(padded(width), height, colour.b),
      coverage(padded(width), height) {}

Canvas make_canvas(ImageView<const Rgb8> background) {
  Canvas canvas(background.width(), background.height(), {});
  tbb::parallel_for(0, canvas.height, [&](int y) {
    const auto from = background.row(y);
    const auto red = canvas.red.row(y), green = canvas.green.row(y), blue = canvas.blue.row(y);
    for (int x = 0; x < canvas.width; ++x) {
      red[x] = from[x].r;
      green[x] = from[x].g;
      blue[x] = from[x].b;
    }
  });
  return canvas;
}

}  // namespace wheatstone
