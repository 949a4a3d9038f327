#include "wheatstone/strokes/missing_strokes_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "wheatstone/strokes/seed_internal.h"

namespace wheatstone {
namespace {

struct UnpaintedCell {
  int left, right, top, bottom;
};

/// 255 where a pixel was wrong before the carried strokes and still is.
Image<std::uint8_t> wrong_still(const CarriedGround& ground) {
  const float squared_threshold = ground.threshold * ground.threshold;
  Image<std::uint8_t> wrong(ground.before.width(), ground.before.height());
  tbb::parallel_for(0, wrong.height(), [&](int y) {
    const auto before = ground.before.row(y), after = ground.after.row(y);
    const auto marks = wrong.row(y);
    for (std::size_t x = 0; x < marks.size(); ++x)
      marks[x] = (int{before[x] > squared_threshold} & int{after[x] > squared_threshold}) != 0 ? 255 : 0;
  });
  return wrong;
}

/// Tested first, because by far the most cells have nothing wrong.
bool has_any(const Image<std::uint8_t>& mask, const UnpaintedCell& cell) {
  const auto size = static_cast<std::size_t>(cell.right - cell.left);
  for (int y = cell.top; y < cell.bottom && size > 0; ++y)
    if (std::memchr(&mask(cell.left, y), 255, size) != nullptr) return true;
  return false;
}

/// Looks at one cell among the pixels beside depth edges, or among the others.
void look_at(const CarriedGround& ground, const UnpaintedCell& cell, bool beside_edge, Image<std::uint8_t>& places) {
  const float squared_threshold = ground.threshold * ground.threshold;
  const auto each = [&](auto visit) {
    for (int y = cell.top; y < cell.bottom; ++y)
      for (int x = cell.left; x < cell.right; ++x)
        if ((!ground.beside.empty() && ground.beside(x, y) != 0) == beside_edge) visit(x, y);
  };
  float worst = squared_threshold;
  int worst_x = 0, worst_y = 0;
  bool any_begun = false;
  each([&](int x, int y) {
    any_begun = any_begun || ground.begun(x, y) != 0;
    if (ground.before(x, y) > worst) worst = ground.before(x, y), worst_x = x, worst_y = y;
  });
  if (worst <= squared_threshold) return;
  // Bare pixels are all equally bad.
  const bool begun = worst >= bare_error ? any_begun : ground.begun(worst_x, worst_y) != 0;
  if (begun || ground.after(worst_x, worst_y) <= squared_threshold) return;
  each([&](int x, int y) {
    if (ground.before(x, y) > squared_threshold && ground.begun(x, y) == 0) places(x, y) = 255;
  });
}

void look_at_all(const CarriedGround& ground, const Image<std::uint8_t>& wrong, float cell_px, bool beside_edge,
                 Image<std::uint8_t>& places) {
  const auto cells = [&](int size) { return static_cast<int>(std::ceil(static_cast<float>(size) / cell_px)); };
  const auto bound = [&](int cell, int size) {
    return std::min(static_cast<int>(static_cast<float>(cell) * cell_px), size);
  };
  tbb::parallel_for(0, cells(places.height()), [&](int row) {
    for (int column = 0; column < cells(places.width()); ++column) {
      const UnpaintedCell cell{bound(column, places.width()), bound(column + 1, places.width()),
                               bound(row, places.height()), bound(row + 1, places.height())};
      if (has_any(wrong, cell)) look_at(ground, cell, beside_edge, places);
    }
  });
}

}  // namespace

Image<std::uint8_t> missing_strokes(const CarriedGround& ground) {
  Image<std::uint8_t> places(ground.before.width(), ground.before.height());
  const Image<std::uint8_t> wrong = wrong_still(ground);
  look_at_all(ground, wrong, std::max(ground.cell_px, 1.f), false, places);
  if (!ground.beside.empty()) look_at_all(ground, wrong, std::max(ground.cell_px / 2, 1.f), true, places);
  return places;
}

}  // namespace wheatstone
