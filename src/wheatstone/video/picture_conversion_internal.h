#pragma once

// Between libav's frames and our pictures: colour matrix and range, chroma's place, and turning.

#include <array>
#include <filesystem>

#include "wheatstone/image/image.h"
#include "wheatstone/video/frame.h"
#include "wheatstone/video/libav_internal.h"

namespace wheatstone {

ColourTags colour_tags_of(AVColorSpace matrix, AVColorRange range, AVColorPrimaries primaries,
                          AVColorTransferCharacteristic transfer);

/// The matrix that a picture is converted with: its tag's or, as players do where there is none, BT.709 from 1280
/// columns or 577 rows on and BT.601 below.
AVColorSpace matrix_in_use(AVColorSpace tagged, int width, int height);

/// libav's name for packed pixels of ours, Rgb8 or Rgb16.
template <class Pixel>
inline constexpr AVPixelFormat packed_format = sizeof(Pixel) == sizeof(Rgb8) ? AV_PIX_FMT_RGB24 : AV_PIX_FMT_RGB48;

/// Whether a format has more than 8 bits a channel.
bool is_deep(AVPixelFormat format);

/// Converts frames of one size to RGB. Makes its tables anew when format or tags change.
template <class Pixel>
class RgbFromFrame {
 public:
  void convert(const AVFrame& frame, Image<Pixel>& picture);

 private:
  OwnedScaler scaler_;
  OwnedFrame rgb_;
  std::array<int, 6> made_for_{};
};

/// Converts RGB pictures of one size to an encoder's format, repeating the last column and row where that is larger.
template <class Pixel>
class FrameFromRgb {
 public:
  FrameFromRgb(int width, int height, AVPixelFormat format, AVColorSpace matrix, AVColorRange range);
  /// The frame is fresh each time: encoders keep what they are given.
  OwnedFrame convert(ImageView<const Pixel> picture);

 private:
  OwnedScaler scaler_;
  OwnedFrame rgb_;
  AVPixelFormat format_;
};

/// One of the eight ways to lie: where a pixel of the stored picture goes. Rows of the matrix as in
/// libavutil/display.h.
struct PictureTurn {
  int a = 1, b = 0, c = 0, d = 1;
  bool is_upright() const { return a == 1 && d == 1; }
  bool swaps_sides() const { return a == 0; }
  /// Clockwise quarter turns times 90; flips are not counted.
  int degrees() const;
};

/// The orientation that a display matrix asks for, rounded to quarter turns.
PictureTurn orientation_of(const std::int32_t* display_matrix);

template <class Pixel>
Image<Pixel> turned(const Image<Pixel>& picture, PictureTurn orientation);

}  // namespace wheatstone
