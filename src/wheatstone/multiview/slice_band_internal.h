#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/multiview/focus.h"
#include "wheatstone/multiview/light_band_internal.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/multiview/tone_map_internal.h"
#include "wheatstone/multiview/view_light_internal.h"

namespace wheatstone {

/// All depth planes of one band of scan lines, as half floats: they stay in a core's cache between being filled and
/// being composited. Column 0 is `left()` of the central view.
class SliceBand {
 public:
  SliceBand() = default;
  /// Planes that hide those behind them have a fourth channel, alpha.
  SliceBand(int left, int right, int rows, int planes, bool hides = false)
      : left_(left),
        right_(right),
        rows_(rows),
        planes_(planes),
        channels_(hides ? 4 : 3),
        stride_(LightBand(left, right, 0, LightBand::most_channels).width_with_margins()),
        // A vector may be read from the last pixel on.
        values_(static_cast<std::size_t>(stride_) * channels_ * rows * planes + 16),
        lit_(static_cast<std::size_t>(stride_ / chunk_width) * rows * planes) {}

  int left() const { return left_; }
  int right() const { return right_; }
  int rows() const { return rows_; }
  int planes() const { return planes_; }
  bool hides() const { return channels_ == 4; }
  int margin() const { return LightBand::margin; }
  std::uint16_t* row(int plane, int row, int channel) {
    return values_.data() + ((static_cast<std::size_t>(plane) * rows_ + row) * channels_ + channel) * stride_ +
           margin();
  }
  const std::uint16_t* row(int plane, int row, int channel) const {
    return const_cast<SliceBand*>(this)->row(plane, row, channel);
  }

  /// Takes the light of a band of the same shape as one plane, and leaves that band dark.
  void take(int plane, LightBand& band);

  /// Pixels of a row that are marked together as lit or dark. Dark ones are stored as zeros.
  static constexpr int chunk_width = 32;
  /// True if any chunk of a row that columns `first` to `end` touch is lit, counted from `left()`, margins included.
  bool lit(int plane, int row, int first, int end) const {
    const std::uint8_t* const chunks = lit_.data() + (static_cast<std::size_t>(plane) * rows_ + row) * chunks_a_row();
    for (int chunk = (first + margin()) / chunk_width; chunk * chunk_width < end + margin(); ++chunk)
      if (chunks[chunk] != 0) return true;
    return false;
  }

 private:
  std::size_t chunks_a_row() const { return static_cast<std::size_t>(stride_) / chunk_width; }
  std::span<std::uint8_t> lit_of(int plane) {
    return std::span(lit_).subspan(chunks_a_row() * rows_ * plane, chunks_a_row() * rows_);
  }

  int left_ = 0, right_ = 0, rows_ = 0, planes_ = 0, channels_ = 3;
  std::ptrdiff_t stride_ = 0;
  std::vector<std::uint16_t> values_;
  std::vector<std::uint8_t> lit_;  // [plane][row][chunk]
};

/// Pixels of a plane that are read for one.
constexpr int taps_of(SliceFilter filter) {
  return filter == SliceFilter::nearest ? 1 : filter == SliceFilter::linear ? 2 : 4;
}

/// The parameters of compositing. Slices are added; slices with alpha are blended front to back, from the first to the
/// last.
struct Compositing {
  std::span<const float> parallaxes;  ///< of the planes, in pixels
  std::span<const ViewPosition> views;
  SliceFilter filter = SliceFilter::centroid;
  /// The area in which the depth differs, in pixels of the picture that is made; empty: none.
  std::optional<Focus> focus = {};
  std::span<const std::vector<float>> shares = {};  ///< [view][plane]: how much of a plane a view sees; empty: all
};

/// Composites every view's part of a band whose first row is `top` in the pictures. All targets are of one size.
void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               std::span<const ViewTarget> targets);

/// A picture each of whose sub-pixels shows one of the views.
struct Interleaved {
  ImageView<Rgb8> picture;
  /// Fills in the numbers of the views that a row shows: three for each pixel, red, green, blue.
  const std::function<void(int y, std::span<std::uint16_t> three_per_pixel)>& views_of_row;
};

/// The same of such a picture: each sub-pixel is composited for its own view, and for no other.
void composite(const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top,
               const Interleaved& to);

/// The light of a band of one view, whose first row is `top` in the picture: columns from 0 on.
void finish_band(const LightBand& band, const ToneMap& tone, int top, const ViewTarget& target);

}  // namespace wheatstone
