#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/multiview/light_band_internal.h"

namespace wheatstone {

/// A band of one view, on which splats that absorb are blended, the nearest first (Hassaine 2010, sec. 4.2.1).
class FrontToBack {
 public:
  /// A pixel through which less comes than the tone map can show is full.
  static constexpr float full = 1.f / 1024;

  /// Columns from 0 to `width`, `rows` of which lie within the picture, the first of them `top`.
  FrontToBack(int width, int rows, int top, ViewPosition view);
  /// Adds the part of a splat that is seen through those before it.
  void blend(const Splat& splat);

  /// Red, green, blue, and what is covered.
  const LightBand& band() const { return band_; }
  /// Pixels of splats that were blended: what is behind full pixels costs nothing.
  std::uint64_t fragments() const { return fragments_; }

 private:
  bool any_open(int first, int end) const;

  static constexpr int block_columns = 16;
  int width_, rows_, top_;
  ViewPosition view_;
  LightBand band_;
  std::vector<int> open_;  ///< pixels that are not full, of each block of columns
  std::uint64_t fragments_ = 0;
};

}  // namespace wheatstone
