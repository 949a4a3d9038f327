#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/multiview/screen_triangles_internal.h"

namespace wheatstone {

/// Where the samples of a pixel are: sample k of `count` is at (k + ½) / count from the upper edge, and at this place
/// from the left one. Rotated grids, as graphics processors have them.
std::span<const float> sample_columns(int count);

/// The triangles that cross a line of samples. A line crosses a triangle between two of its edges, whose places and
/// disparities on the line are the same for all views.
struct CrossedLine {
  struct Edges {
    float x0, disparity0, x1, disparity1;  ///< places in the central view
  };
  struct Between {
    float nearness0, nearness1;  ///< at the two edges
    std::uint32_t triangle;
  };
  std::vector<Edges> edges;
  std::vector<Between> between;
};

/// Some rows of pixels, of which each has a line of samples for each sample of a pixel, and the triangles that cross
/// these lines: a view costs two products and what lies between the edges.
class TriangleBand {
 public:
  static constexpr std::uint32_t nothing = ~std::uint32_t{0};
  static constexpr std::size_t block = 16;  ///< the most samples of a line that are filled at a time

  TriangleBand(int width, int samples);

  /// Forgets all, and begins rows first_row, … end_row − 1.
  void begin(int first_row, int end_row);

  /// Adds a triangle. It crosses the lines from its upper corner to before its lower one.
  void add(const ScreenTriangle& triangle, std::uint32_t index, bool is_orthographic);

  /// Finds which triangle each sample of the view at a position shows: the nearest, and of equally near ones the one
  /// that was added first. A sample that lies on a triangle's left edge belongs to it, one on its right edge does not:
  /// on a common edge of triangles, it belongs to one of them.
  void show(float view);

  /// The triangles that the samples of a line show.
  std::span<const std::uint32_t> line(int row, int sample) const {
    const auto line = static_cast<std::size_t>(row - first_row_) * static_cast<std::size_t>(samples_) +
                      static_cast<std::size_t>(sample);
    return std::span(shown_).subspan(line * stride_, static_cast<std::size_t>(width_));
  }
  int samples() const { return samples_; }
  int width() const { return width_; }

 private:
  int width_, samples_;
  std::size_t stride_;  ///< of lines: whole blocks
  std::span<const float> columns_;
  int first_row_ = 0, end_row_ = 0;
  std::vector<CrossedLine> lines_;
  std::vector<float> nearest_;
  std::vector<std::uint32_t> shown_;
};

}  // namespace wheatstone
