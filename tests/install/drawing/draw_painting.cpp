#include <wheatstone/drawing/draw.h>
#include <wheatstone/marks/painting_file.h>

int main() {
  const wheatstone::Painting painting{wheatstone::StrokePainting{32, 20, {200, 40, 20}, {}}};
  wheatstone::write_painting("drawn.wst", painting);
  const wheatstone::DrawnView drawn = wheatstone::draw(wheatstone::read_painting("drawn.wst"), wheatstone::left_eye);
  return drawn.picture.width() == 32 && drawn.picture(5, 5) == wheatstone::Rgb8{200, 40, 20} ? 0 : 1;
}
