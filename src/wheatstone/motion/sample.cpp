// Values between pixels.
#include <algorithm>
#include <cmath>

#include "wheatstone/motion/flow.h"

namespace wheatstone {
namespace {

/// The four pixels about a place, and how far it lies from the first to the last.
struct Cell {
  int left, right, top, bottom;
  float across, down;
};

Cell cell_at(int width, int height, float x, float y) {
  const float column = std::clamp(x - 0.5f, 0.f, static_cast<float>(width - 1));
  const float row = std::clamp(y - 0.5f, 0.f, static_cast<float>(height - 1));
  const int left = static_cast<int>(column), top = static_cast<int>(row);
  return {left,
          std::min(left + 1, width - 1),
          top,
          std::min(top + 1, height - 1),
          column - static_cast<float>(left),
          row - static_cast<float>(top)};
}

float blend(const Cell& cell, float a, float b, float c, float d) {
  const float above = a + (b - a) * cell.across, below = c + (d - c) * cell.across;
  return above + (below - above) * cell.down;
}

}  // namespace

float sample(ImageView<const float> image, float x, float y) {
  const Cell cell = cell_at(image.width(), image.height(), x, y);
  return blend(cell, image(cell.left, cell.top), image(cell.right, cell.top), image(cell.left, cell.bottom),
               image(cell.right, cell.bottom));
}

SampledColour sample(ImageView<const Rgb8> image, float x, float y) {
  const Cell cell = cell_at(image.width(), image.height(), x, y);
  const Rgb8 a = image(cell.left, cell.top), b = image(cell.right, cell.top), c = image(cell.left, cell.bottom),
             d = image(cell.right, cell.bottom);
  return {blend(cell, a.r, b.r, c.r, d.r), blend(cell, a.g, b.g, c.g, d.g), blend(cell, a.b, b.b, c.b, d.b)};
}

}  // namespace wheatstone
