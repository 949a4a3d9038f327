#include "wheatstone/video/picture_conversion_internal.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <new>
#include <numbers>
#include <span>
#include <type_traits>

namespace wheatstone {
namespace {

// Slower than the default by a factor of two; without them chroma is doubled instead of interpolated and grey is off by
// one.
constexpr int careful = SWS_BICUBIC | SWS_FULL_CHR_H_INT | SWS_FULL_CHR_H_INP | SWS_ACCURATE_RND | SWS_BITEXACT;

std::string or_empty(const char* name) {
  const std::string text = name == nullptr ? "" : name;
  return text == "unknown" || text == "unspecified" ? "" : text;
}

const int* coefficients_of(AVColorSpace matrix) {
  switch (matrix) {
    case AVCOL_SPC_BT709:
      return libav().sws_getCoefficients(SWS_CS_ITU709);
    case AVCOL_SPC_FCC:
      return libav().sws_getCoefficients(SWS_CS_FCC);
    case AVCOL_SPC_SMPTE240M:
      return libav().sws_getCoefficients(SWS_CS_SMPTE240M);
    case AVCOL_SPC_BT2020_NCL:
    case AVCOL_SPC_BT2020_CL:
      return libav().sws_getCoefficients(SWS_CS_BT2020);
    default:
      return libav().sws_getCoefficients(SWS_CS_ITU601);
  }
}

bool is_full_range(AVPixelFormat format, AVColorRange range) {
  if (range == AVCOL_RANGE_UNSPECIFIED) {
    return format == AV_PIX_FMT_YUVJ420P || format == AV_PIX_FMT_YUVJ422P || format == AV_PIX_FMT_YUVJ444P ||
           format == AV_PIX_FMT_YUVJ440P || format == AV_PIX_FMT_YUVJ411P;
  }
  return range == AVCOL_RANGE_JPEG;
}

/// Where 4:2:0's chroma lies, in 1/256 of a luma pixel, as swscale wants it.
struct ChromaPlace {
  int across = 0;
  int down = 128;
};

ChromaPlace chroma_place(AVChromaLocation location) {
  switch (location) {
    case AVCHROMA_LOC_CENTER:
      return {128, 128};
    case AVCHROMA_LOC_TOPLEFT:
      return {0, 0};
    case AVCHROMA_LOC_TOP:
      return {128, 0};
    default:
      return {0, 128};
  }
}

SwsContext& prepared(SwsContext* scaler, int width, int height, AVPixelFormat from, AVPixelFormat to) {
  if (scaler == nullptr) throw std::bad_alloc();
  libav().av_opt_set_int(scaler, "srcw", width, 0);
  libav().av_opt_set_int(scaler, "srch", height, 0);
  libav().av_opt_set_int(scaler, "dstw", width, 0);
  libav().av_opt_set_int(scaler, "dsth", height, 0);
  libav().av_opt_set_int(scaler, "src_format", from, 0);
  libav().av_opt_set_int(scaler, "dst_format", to, 0);
  libav().av_opt_set_int(scaler, "sws_flags", careful, 0);
  return *scaler;
}

bool is_rgb(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = libav().av_pix_fmt_desc_get(format);
  return description != nullptr && (description->flags & AV_PIX_FMT_FLAG_RGB) != 0;
}

// Where swscale comes from luma and chroma, or goes there, white is 255 * 256 in its RGB of 16 bits. Ours is 255 * 257.

void from_swscale(std::span<Rgb16> row) {
  const auto scaled = [](std::uint16_t code) {
    return static_cast<std::uint16_t>(std::min(code + (code + 128) / 256, 65535));
  };
  for (Rgb16& pixel : row) pixel = {scaled(pixel.r), scaled(pixel.g), scaled(pixel.b)};
}

void to_swscale(std::span<Rgb16> row) {
  const auto scaled = [](std::uint16_t code) { return static_cast<std::uint16_t>(code - (code + 128) / 257); };
  for (Rgb16& pixel : row) pixel = {scaled(pixel.r), scaled(pixel.g), scaled(pixel.b)};
}

/// The packed pixels that swscale takes to a format. Of bytes, it would make white 255 * 256 in RGB of 16 bits.
template <class Pixel>
AVPixelFormat packed_for(AVPixelFormat format) {
  return is_rgb(format) && is_deep(format) ? AV_PIX_FMT_RGB48 : packed_format<Pixel>;
}

Rgb16 with_sixteen_bits(Rgb8 colour) {
  const auto word = [](std::uint8_t byte) { return static_cast<std::uint16_t>(byte * deep_level); };
  return {word(colour.r), word(colour.g), word(colour.b)};
}

template <class Packed>
std::span<Packed> row_of(AVFrame& frame, int y) {
  auto* const first = frame.data[0] + static_cast<std::ptrdiff_t>(y) * frame.linesize[0];
  return {reinterpret_cast<Packed*>(first), static_cast<std::size_t>(frame.width)};  // NOLINT
}

/// A row of a picture, each pixel as `as` makes it, the last one repeated to the end.
template <class Pixel, class Packed, class As>
void put_row(std::span<const Pixel> row, std::span<Packed> to, As as) {
  std::ranges::fill(std::ranges::transform(row, to.begin(), as).out, to.end(), as(row.back()));
}

OwnedFrame frame_of(int width, int height, AVPixelFormat format) {
  OwnedFrame frame = new_frame();
  frame->width = width;
  frame->height = height;
  frame->format = format;
  if (libav().av_frame_get_buffer(frame.get(), 0) < 0) throw std::bad_alloc();
  return frame;
}

}  // namespace

ColourTags colour_tags_of(AVColorSpace matrix, AVColorRange range, AVColorPrimaries primaries,
                          AVColorTransferCharacteristic transfer) {
  return {or_empty(libav().av_color_space_name(matrix)), or_empty(libav().av_color_range_name(range)),
          or_empty(libav().av_color_primaries_name(primaries)), or_empty(libav().av_color_transfer_name(transfer))};
}

AVColorSpace matrix_in_use(AVColorSpace tagged, int width, int height) {
  if (tagged != AVCOL_SPC_UNSPECIFIED && tagged != AVCOL_SPC_RESERVED) return tagged;
  return width >= 1280 || height > 576 ? AVCOL_SPC_BT709 : AVCOL_SPC_SMPTE170M;
}

bool is_deep(AVPixelFormat format) {
  const AVPixFmtDescriptor* description = libav().av_pix_fmt_desc_get(format);
  return description != nullptr && description->comp[0].depth > 8;
}

template <class Pixel>
void RgbFromFrame<Pixel>::convert(const AVFrame& frame, Image<Pixel>& picture) {
  const auto format = static_cast<AVPixelFormat>(frame.format);
  const AVColorSpace matrix = matrix_in_use(frame.colorspace, frame.width, frame.height);
  const std::array<int, 6> wanted = {frame.width, frame.height,      frame.format,
                                     matrix,      frame.color_range, frame.chroma_location};
  if (!scaler_ || wanted != made_for_) {
    scaler_.reset(libav().sws_alloc_context());
    SwsContext& scaler = prepared(scaler_.get(), frame.width, frame.height, format, packed_format<Pixel>);
    const AVPixFmtDescriptor* description = libav().av_pix_fmt_desc_get(format);
    if (description != nullptr && description->log2_chroma_w == 1) {
      const ChromaPlace place = chroma_place(frame.chroma_location);
      libav().av_opt_set_int(&scaler, "src_h_chr_pos", place.across, 0);
      if (description->log2_chroma_h == 1) libav().av_opt_set_int(&scaler, "src_v_chr_pos", place.down, 0);
    }
    if (libav().sws_init_context(&scaler, nullptr, nullptr) < 0) throw std::bad_alloc();
    libav().sws_setColorspaceDetails(&scaler, coefficients_of(matrix), is_full_range(format, frame.color_range) ? 1 : 0,
                                     libav().sws_getCoefficients(SWS_CS_DEFAULT), 1, 0, 1 << 16, 1 << 16);
    rgb_ = frame_of(frame.width, frame.height, packed_format<Pixel>);
    made_for_ = wanted;
  }

  // Not straight into the picture: swscale's vectors may write past the end of an unpadded row.
  libav().sws_scale(scaler_.get(), frame.data, frame.linesize, 0, frame.height, rgb_->data, rgb_->linesize);
  // A picture that was moved from still tells its size, but has no pixels.
  if (picture.width() != frame.width || picture.height() != frame.height || picture.empty()) {
    picture = Image<Pixel>(frame.width, frame.height);
  }
  for (int y = 0; y < frame.height; ++y) {
    std::memcpy(picture.row(y).data(), rgb_->data[0] + static_cast<std::ptrdiff_t>(y) * rgb_->linesize[0],
                picture.row(y).size_bytes());
    if constexpr (std::is_same_v<Pixel, Rgb16>)
      if (!is_rgb(format)) from_swscale(picture.row(y));
  }
}

template <class Pixel>
FrameFromRgb<Pixel>::FrameFromRgb(int width, int height, AVPixelFormat format, AVColorSpace matrix, AVColorRange range)
    : scaler_(libav().sws_alloc_context()), rgb_(frame_of(width, height, packed_for<Pixel>(format))), format_(format) {
  SwsContext& scaler = prepared(scaler_.get(), width, height, packed_for<Pixel>(format), format);
  const AVPixFmtDescriptor* description = libav().av_pix_fmt_desc_get(format);
  if (description->log2_chroma_w == 1) {
    const ChromaPlace place = chroma_place(AVCHROMA_LOC_LEFT);
    libav().av_opt_set_int(&scaler, "dst_h_chr_pos", place.across, 0);
    if (description->log2_chroma_h == 1) libav().av_opt_set_int(&scaler, "dst_v_chr_pos", place.down, 0);
  }
  if (libav().sws_init_context(&scaler, nullptr, nullptr) < 0) throw std::bad_alloc();
  libav().sws_setColorspaceDetails(&scaler, libav().sws_getCoefficients(SWS_CS_DEFAULT), 1, coefficients_of(matrix),
                                   is_rgb(format) || range == AVCOL_RANGE_JPEG ? 1 : 0, 0, 1 << 16, 1 << 16);
}

template <class Pixel>
OwnedFrame FrameFromRgb<Pixel>::convert(ImageView<const Pixel> picture) {
  for (int y = 0; y < rgb_->height; ++y) {
    const std::span<const Pixel> row = picture.row(std::min(y, picture.height() - 1));
    if constexpr (std::is_same_v<Pixel, Rgb8>) {
      if (rgb_->format == packed_format<Rgb16>) {
        put_row(row, row_of<Rgb16>(*rgb_, y), with_sixteen_bits);
        continue;
      }
    }
    const std::span<Pixel> target = row_of<Pixel>(*rgb_, y);
    put_row(row, target, std::identity());
    if constexpr (std::is_same_v<Pixel, Rgb16>)
      if (!is_rgb(format_)) to_swscale(target);
  }
  OwnedFrame frame = frame_of(rgb_->width, rgb_->height, format_);
  libav().sws_scale(scaler_.get(), rgb_->data, rgb_->linesize, 0, rgb_->height, frame->data, frame->linesize);
  return frame;
}

int PictureTurn::degrees() const {
  // The direction that the stored picture's x axis takes.
  const double angle = std::atan2(b, a) * 180 / std::numbers::pi;
  return static_cast<int>(std::lround(angle + 360)) % 360;
}

PictureTurn orientation_of(const std::int32_t* display_matrix) {
  // x' = a·x + c·y, y' = b·x + d·y; 16.16 fixed point.
  const auto at = [&](int index) { return static_cast<double>(display_matrix[index]); };
  const auto sign = [](double value) { return value < 0 ? -1 : 1; };
  const double a = at(0), b = at(1), c = at(3), d = at(4);
  if (a == 0 && b == 0) return {};
  if (std::abs(a) >= std::abs(b)) return {sign(a), 0, 0, sign(d)};
  return {0, sign(b), sign(c), 0};
}

template <class Pixel>
Image<Pixel> turned(const Image<Pixel>& picture, PictureTurn orientation) {
  const int width = picture.width(), height = picture.height();
  Image<Pixel> result(orientation.swaps_sides() ? height : width, orientation.swaps_sides() ? width : height);
  // What would come to lie left of or above the origin is moved by the picture's extent.
  const int x_origin = orientation.a + orientation.c < 0 ? result.width() - 1 : 0;
  const int y_origin = orientation.b + orientation.d < 0 ? result.height() - 1 : 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      result(x_origin + orientation.a * x + orientation.c * y, y_origin + orientation.b * x + orientation.d * y) =
          picture(x, y);
    }
  }
  return result;
}

template class RgbFromFrame<Rgb8>;
template class RgbFromFrame<Rgb16>;
template class FrameFromRgb<Rgb8>;
template class FrameFromRgb<Rgb16>;
template Image<Rgb8> turned(const Image<Rgb8>&, PictureTurn);
template Image<Rgb16> turned(const Image<Rgb16>&, PictureTurn);

}  // namespace wheatstone
