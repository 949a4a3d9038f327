#include "wheatstone/stereo/retouched_right.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <span>
#include <utility>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/image/shared_image.h"

namespace wheatstone {
namespace {

bool differs(Rgb8 a, Rgb8 b) {
  constexpr int tolerance = 24;
  return std::abs(a.r - b.r) > tolerance || std::abs(a.g - b.g) > tolerance || std::abs(a.b - b.b) > tolerance;
}

/// One row of both pictures, and of the geometries.
class RetouchedRow {
 public:
  RetouchedRow(const StereoPairView& pictures, const StereoGeometryView& found, const StereoGeometryView& retouched,
               int y)
      : pictures_(pictures), found_(found), retouched_(retouched), y_(y), width_(pictures.left.width()) {}

  bool has_changed() const {
    return !std::ranges::equal(found_.left_disparity.row(y_), retouched_.left_disparity.row(y_));
  }

  /// Gives the row what it is to show. Returns whether any pixel changes.
  bool change(std::span<Rgb8> row) const {
    bool changes = false;
    for (int x = 0; x < width_; ++x) {
      const std::optional<int> now = seen_by_left(retouched_, x);
      if (!now || !(has_moved(*now) || shows_what_moved(x)) || !differs(left(*now), right(x))) continue;
      row[static_cast<std::size_t>(x)] = left(*now);
      changes = true;
    }
    for (int begin = 0; begin < width_; ++begin) {
      const int end = end_of_hidden(begin), end_of_left = end_of_left_behind(begin, end);
      if (end_of_left > begin && end_of_left < width_) {
        continue_behind(begin, end_of_left, row);
        changes = true;
      }
      begin = std::max(begin, end - 1);
    }
    return changes;
  }

 private:
  Rgb8 left(int x) const { return pictures_.left(x, y_); }
  Rgb8 right(int x) const { return pictures_.right(x, y_); }

  bool has_moved(int left_column) const {
    constexpr float least_px = 0.5f;
    return std::abs(retouched_.left_disparity(left_column, y_) - found_.left_disparity(left_column, y_)) > least_px;
  }

  /// The left picture's column that shows what lies at a column of the right one; none where that is hidden from it.
  std::optional<int> seen_by_left(const StereoGeometryView& geometry, int x) const {
    if (geometry.right_occlusion(x, y_) != 0) return {};
    const int column = floor_of(static_cast<float>(x) + 0.5f + geometry.right_disparity(x, y_));
    return column >= 0 && column < width_ ? std::optional(column) : std::nullopt;
  }

  /// Whether a column of the right picture shows what lies elsewhere now.
  bool shows_what_moved(int x) const {
    const std::optional<int> then = seen_by_left(found_, x);
    return then && has_moved(*then);
  }

  /// The end of the columns that are hidden from the left picture, from a hidden one on.
  int end_of_hidden(int x) const {
    while (x < width_ && !seen_by_left(retouched_, x)) ++x;
    return x;
  }

  /// The end of those of these columns, from the first on, of which most show something that moved away.
  int end_of_left_behind(int begin, int end) const {
    int count = 0, last = begin;
    for (int x = begin; x < end; ++x) {
      if (!shows_what_moved(x) || differs(left(*seen_by_left(found_, x)), right(x))) continue;
      if (2 * ++count > x + 1 - begin) last = x + 1;
    }
    return last;
  }

  /// Mirrors in these columns the farther surface: what is hidden from the left picture lies to the right of what hides
  /// it.
  void continue_behind(int begin, int end, std::span<Rgb8> row) const {
    constexpr float farther_px = 2;
    const float depth = retouched_.right_disparity(end, y_);
    for (int x = begin; x < end; ++x) {
      const int mirrored = std::min(2 * end - 1 - x, width_ - 1);
      const bool is_farther = retouched_.right_disparity(mirrored, y_) <= depth + farther_px;
      row[static_cast<std::size_t>(x)] = row[static_cast<std::size_t>(is_farther ? mirrored : end)];
    }
  }

  const StereoPairView& pictures_;
  const StereoGeometryView &found_, &retouched_;
  int y_, width_;
};

}  // namespace

Image<Rgb8> retouched_right(const StereoPairView& pictures, const StereoGeometryView& found,
                            const StereoGeometryView& retouched) {
  Image<Rgb8> right = copy_of(pictures.right);
  std::atomic<bool> changes = false;
  tbb::parallel_for(0, right.height(), [&](int y) {
    RetouchedRow row(pictures, found, retouched, y);
    if (row.has_changed() && row.change(right.row(y))) changes = true;
  });
  return changes ? std::move(right) : Image<Rgb8>();
}

}  // namespace wheatstone
