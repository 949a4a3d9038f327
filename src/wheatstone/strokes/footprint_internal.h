#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "wheatstone/marks/spline.h"
#include "wheatstone/strokes/fit_stroke_internal.h"

namespace wheatstone {

/// A point of a chain of straight segments, and the length of the chain up to it.
struct ChainPoint {
  float x, y, along;
};

/// Rows and columns of pixels of a tile: [left, right), and every `row_step`th row of [top, bottom).
struct FootprintArea {
  int left, top, right, bottom, row_step;

  int columns() const { return std::max(right - left, 0); }
  int rows() const { return std::max((bottom - top + row_step - 1) / row_step, 0); }
};

/// The distance of each pixel's centre from a chain of at least two points, squared, at most `reach_px` squared; and
/// the length of the chain up to its nearest point, which is unset where the chain is farther. A row of the area has
/// `row_length` numbers, at least as many as columns and footprint_padding.
void measure_footprint(std::span<const ChainPoint> chain, const FootprintArea& area, float reach_px, int row_length,
                       float* squared, float* along);
inline constexpr int footprint_padding = 16;

/// The pixels of a stroke: the distance from its curve, and the share of its length, 0..1.
class Footprint {
 public:
  /// Calls `visit(x, y, distance, share)` for pixels of a tile nearer than `reach_px` to the spline of these control
  /// points, in every `row_step`th row.
  template <class Visit>
  void visit(const FitTile& tile, std::span<const PlanePoint> controls, float reach_px, int row_step, Visit visit) {
    flatten(controls);
    const auto [left, right] = std::ranges::minmax(chain_, {}, &ChainPoint::x);
    const auto [top, bottom] = std::ranges::minmax(chain_, {}, &ChainPoint::y);
    const FootprintArea area{std::max(static_cast<int>(left.x - reach_px), 0),
                             std::max(static_cast<int>(top.y - reach_px), 0),
                             std::min(static_cast<int>(right.x + reach_px) + 1, tile.width),
                             std::min(static_cast<int>(bottom.y + reach_px) + 1, tile.height), row_step};
    const int columns = area.columns(), rows = area.rows(), row_length = columns + footprint_padding;
    squared_.resize(static_cast<std::size_t>(row_length) * static_cast<std::size_t>(rows));
    along_.resize(squared_.size());
    measure_footprint(chain_, area, reach_px, row_length, squared_.data(), along_.data());
    const float length = std::max(chain_.back().along, 1e-3f), squared_reach = reach_px * reach_px;
    for (int row = 0; row < rows; ++row) {
      const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(row_length);
      for (int i = 0; i < columns; ++i) {
        const float squared = squared_[first + i];
        if (squared < squared_reach)
          visit(area.left + i, area.top + row * row_step, std::sqrt(squared), along_[first + i] / length);
      }
    }
  }

 private:
  void flatten(std::span<const PlanePoint> controls);
  void add(PlanePoint point);

  std::vector<ControlPoint> points_;
  std::vector<ChainPoint> chain_;
  std::vector<float> squared_, along_;
};

}  // namespace wheatstone
