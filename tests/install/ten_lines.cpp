#include <wheatstone/wheatstone.h>

int main() {
  wheatstone::Image<wheatstone::Rgb8> picture(32, 20, {200, 40, 20});
  wheatstone::write_image("picture.png", picture);
  wheatstone::write_painting("painting.wst", {wheatstone::StrokePainting{.width = 32, .height = 20}});
  const bool same = wheatstone::read_image("picture.png") == picture;
  return same && wheatstone::width_of(wheatstone::read_painting("painting.wst")) == 32 ? 0 : 1;
}
