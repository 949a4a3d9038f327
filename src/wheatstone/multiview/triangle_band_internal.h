#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "wheatstone/multiview/screen_triangles_internal.h"

namespace wheatstone {

/// Where the samples of a pixel are: sample k of `count` is at (k + ½) / count from the upper edge, and at this place
/// from the left one. Rotated grids, as graphics processors have them.
std::span<const double> sample_columns(int count);

/// Which triangle the samples of some rows of a view show: one line of samples each, `samples` lines a row.
class TriangleBand {
 public:
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};

  TriangleBand(int width, int samples);

  /// Forgets all, and begins rows first_row, … end_row − 1 of a view.
  void begin(int first_row, int end_row);

  /// Draws a triangle as the view at a position has it. A sample belongs to it where it lies on its left edge or
  /// between its edges, on rows from its upper corner to before its lower one: of triangles with a common edge it
  /// belongs to one. The nearest is kept, and of equally near ones the one that was drawn first.
  void draw(const ScreenTriangle& triangle, std::uint32_t index, double view, bool is_orthographic);

  std::span<const std::uint32_t> line(int row, int sample) const {
    const auto line = static_cast<std::size_t>((row - first_row_) * samples_ + sample);
    return std::span(shown_).subspan(line * static_cast<std::size_t>(width_), static_cast<std::size_t>(width_));
  }
  int samples() const { return samples_; }
  int width() const { return width_; }

 private:
  int width_, samples_;
  std::span<const double> columns_;
  int first_row_ = 0, end_row_ = 0;
  std::vector<float> nearness_;
  std::vector<std::uint32_t> shown_;
};

}  // namespace wheatstone
