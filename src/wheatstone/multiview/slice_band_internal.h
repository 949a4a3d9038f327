#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/multiview/focus.h"
#include "wheatstone/multiview/light_band_internal.h"
#include "wheatstone/multiview/tone_map_internal.h"
#include "wheatstone/multiview/view_light_internal.h"

namespace wheatstone {

/// All depth planes of one band of scan lines, as half floats: they stay in a core's cache between being filled and
/// being composited. Column 0 is `left()` of the central view.
class SliceBand {
 public:
  SliceBand() = default;
  SliceBand(int left, int right, int rows, int planes);

  int left() const { return left_; }
  int right() const { return right_; }
  int rows() const { return rows_; }
  int planes() const { return planes_; }
  int margin() const { return LightBand::margin; }
  std::uint16_t* row(int plane, int row, int channel) {
    return values_.data() + ((static_cast<std::size_t>(plane) * rows_ + row) * 3 + channel) * stride_ + margin();
  }
  const std::uint16_t* row(int plane, int row, int channel) const {
    return const_cast<SliceBand*>(this)->row(plane, row, channel);
  }

  /// Takes the light of a band of the same shape as one plane, and leaves that band dark.
  void take(int plane, LightBand& band);

  /// Columns, counted from `left()`, outside of which a row of a plane is dark.
  struct Extent {
    int first = 0, end = 0;
    bool meets(int from, int to) const { return first < to && from < end; }
  };
  const Extent& lit(int plane, int row) const { return lit_[static_cast<std::size_t>(plane) * rows_ + row]; }

 private:
  int left_ = 0, right_ = 0, rows_ = 0, planes_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> values_;
  std::vector<Extent> lit_;
};

/// How a slice is read between its pixels.
enum class Resampling { nearest, linear, cubic };
/// Pixels that are read for one.
constexpr int taps_of(Resampling resampling) {
  return resampling == Resampling::nearest ? 1 : resampling == Resampling::linear ? 2 : 4;
}

/// What compositing needs besides the slices.
struct Compositing {
  std::span<const float> parallaxes;  ///< of the planes, in pixels
  std::span<const ViewPosition> views;
  Resampling resampling = Resampling::cubic;
  /// Where the depth differs, in pixels of the picture that is made; nothing: nowhere.
  std::optional<Focus> focus = {};
  std::span<const std::vector<float>> shares = {};  ///< [view][plane]: how much of a plane a view sees; empty: all
};

/// Composites every view's part of a band whose first row is `top` in the pictures. All targets are of one size.
void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               std::span<const ViewTarget> targets);

/// The light of a band of one view, whose first row is `top` in the picture: columns from 0 on.
void finish_band(const LightBand& band, const ToneMap& tone, int top, const ViewTarget& target);

}  // namespace wheatstone
