#include "wheatstone/painting/canvas.h"

#include <tbb/parallel_for.h>

#include <algorithm>

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

Image<Rgb8> to_picture(const Canvas& canvas) {
  Image<Rgb8> picture(canvas.width, canvas.height);
  const auto rounded = [](float value) { return static_cast<std::uint8_t>(std::clamp(value, 0.f, 255.f) + 0.5f); };
  tbb::parallel_for(0, canvas.height, [&](int y) {
    const auto red = canvas.red.row(y), green = canvas.green.row(y), blue = canvas.blue.row(y);
    const auto to = picture.row(y);
    for (int x = 0; x < canvas.width; ++x) to[x] = {rounded(red[x]), rounded(green[x]), rounded(blue[x])};
  });
  return picture;
}

double bare_share(const Canvas& canvas) {
  std::size_t bare = 0;
  for (int y = 0; y < canvas.height; ++y)
    bare += std::ranges::count_if(canvas.coverage.row(y).first(canvas.width), [](float c) { return c < 0.5f; });
  const std::size_t pixels = static_cast<std::size_t>(canvas.width) * canvas.height;
  return pixels == 0 ? 0 : static_cast<double>(bare) / static_cast<double>(pixels);
}

}  // namespace wheatstone
