#include "wheatstone/strokes/bare_pixels_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace wheatstone {

Layer strokes_near_bare(const Layer& layer, ImageView<const std::uint8_t> bare) {
  constexpr int block_px = 16;
  const int columns = bare.width() / block_px + 1, rows = bare.height() / block_px + 1;
  Image<std::uint8_t> has_bare(columns, rows);
  tbb::parallel_for(0, rows, [&](int row) {
    const auto marks = has_bare.row(row);
    for (int y = row * block_px; y < std::min((row + 1) * block_px, bare.height()); ++y) {
      const auto here = bare.row(y);
      for (std::size_t x = 0; x < here.size(); ++x) marks[x / block_px] |= here[x];
    }
  });
  const auto block = [](float place, int count) {
    return std::clamp(static_cast<int>(std::floor(place / block_px)), 0, count - 1);
  };
  const auto may_cover = [&](const Stroke& stroke) {
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    const auto [left, right] = std::ranges::minmax_element(points, {}, &ControlPoint::x);
    const auto [top, bottom] = std::ranges::minmax_element(points, {}, &ControlPoint::y);
    const float reach = stroke.radius_px + 1;
    for (int row = block(top->y - reach, rows); row <= block(bottom->y + reach, rows); ++row)
      for (int column = block(left->x - reach, columns); column <= block(right->x + reach, columns); ++column)
        if (has_bare(column, row) != 0) return true;
    return false;
  };
  std::vector<std::uint8_t> is_near(layer.strokes.size());
  tbb::parallel_for(std::size_t{0}, is_near.size(), [&](std::size_t i) { is_near[i] = may_cover(layer.strokes[i]); });
  Layer near{layer.radius_px, {}, {}};  // few strokes: all points would be many
  for (std::size_t i = 0; i < is_near.size(); ++i) {
    if (is_near[i] == 0) continue;
    Stroke stroke = layer.strokes[i];
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    stroke.first_point = static_cast<std::uint32_t>(near.points.size());
    near.points.insert(near.points.end(), points.begin(), points.end());
    near.strokes.push_back(stroke);
  }
  return near;
}

}  // namespace wheatstone
