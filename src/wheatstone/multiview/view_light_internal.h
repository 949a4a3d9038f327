#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Light of one view, channel by channel, as large as one of its pictures (SplatOrder).
class ViewLight {
 public:
  ViewLight() = default;
  ViewLight(int width, int rows, int channels)
      : width_(width),
        rows_(rows),
        channels_(channels),
        // Whole blocks are written, and read a little beyond.
        stride_((width + 127) / 64 * 64 + 16),
        values_(static_cast<std::size_t>(stride_) * rows * channels + 64) {}
  int width() const { return width_; }
  int rows() const { return rows_; }
  int channels() const { return channels_; }
  float* row(int y, int channel) {
    return values_.data() + static_cast<std::size_t>(stride_) * (static_cast<std::size_t>(y) * channels_ + channel);
  }
  /// All channels, and what lies beside them.
  std::span<float> whole_row(int y) { return {row(y, 0), static_cast<std::size_t>(stride_) * channels_}; }
  const float* row(int y, int channel) const { return const_cast<ViewLight*>(this)->row(y, channel); }

 private:
  int width_ = 0, rows_ = 0, channels_ = 0;
  std::ptrdiff_t stride_ = 0;
  std::vector<float> values_;
};

/// The target of one view's sums: they become a picture's bytes, or stay light. The light of the picture of half the
/// size is added to them.
struct ViewTarget {
  const ViewLight* smaller = nullptr;
  int pad = 0;  ///< of the picture that is made (SplatOrder::pad)
  ViewLight* light = nullptr;
  ImageView<Rgb8> picture;
  int width() const { return light != nullptr ? light->width() : picture.width(); }
  int height() const { return light != nullptr ? light->rows() : picture.height(); }
};

}  // namespace wheatstone
