#include "wheatstone/pictures/png_reader_internal.h"

#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>
#include <limits>
#include <utility>

#include "wheatstone/pictures/png_chunks.h"
#include "wheatstone/pictures/upright.h"

namespace wheatstone {

namespace {

bool is_needed(std::string_view type) {
  constexpr std::string_view needed[] = {"IHDR", "PLTE", "tRNS", "IDAT", "IEND", "eXIf"};
  return std::find(std::begin(needed), std::end(needed), type) != std::end(needed);
}

}  // namespace

std::optional<std::string> plain_png(std::string_view bytes) {
  const auto chunks = png_chunks(bytes);
  if (!chunks) return {};
  std::string plain(bytes.substr(0, png_signature_size));
  for (const PngChunk& chunk : *chunks)
    if (is_needed(chunk.type)) plain += chunk.whole;
  return plain;
}

namespace {

/// libpng leaves a function that has failed by a long jump: those that call it here have no local objects.
class PngReader : public PictureReader {
 public:
  PngReader(std::string_view bytes, StoredAlpha alpha, int orientation) : bytes_(bytes), alpha_(alpha) {
    picture_.put("Orientation", orientation);
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, fail, [](png_structp, png_const_charp) {});
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  ~PngReader() override { png_destroy_read_struct(&png_, &info_, nullptr); }

  bool open() {
    if (info_ == nullptr) return give_up("no memory");
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    png_set_read_fn(png_, this, give);
    png_read_info(png_, info_);
    png_set_expand(png_);
    if constexpr (std::endian::native == std::endian::little) png_set_swap(png_);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    describe();
    return true;
  }

  std::string format() const override { return "png"; }
  const StoredPicture& picture() const override { return picture_; }
  bool go_to(int picture) override { return picture == 0; }
  bool read(std::uint8_t* to) override {
    if (!decode_to(to)) return false;
    if (multiplies()) multiply(to, pixels());
    return true;
  }
  bool read(int first_row, int rows, int channels, float* to) override {
    if (decoded_.empty() && !decode()) return false;
    const auto first = static_cast<std::size_t>(first_row) * static_cast<std::size_t>(picture_.width);
    const auto count = static_cast<std::size_t>(rows) * static_cast<std::size_t>(picture_.width);
    if (picture_.kind == bytes_kind) {
      bring_to_one(decoded_.data(), first, count, channels, to);
    } else {
      bring_to_one(reinterpret_cast<const std::uint16_t*>(decoded_.data()), first, count, channels, to);
    }
    return true;
  }
  std::string complaint() override { return std::exchange(complaint_, {}); }

 private:
  [[noreturn]] static void fail(png_structp png, png_const_charp why) {
    static_cast<PngReader*>(png_get_error_ptr(png))->complaint_ = why;
    png_longjmp(png, 1);
  }
  static void give(png_structp png, png_bytep to, std::size_t count) {
    auto* const self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self->bytes_.size()) png_error(png, "it ends too early");
    std::memcpy(to, self->bytes_.data(), count);
    self->bytes_.remove_prefix(count);
  }
  bool give_up(const char* why) {
    complaint_ = why;
    return false;
  }

  void describe() {
    picture_.width = static_cast<int>(png_get_image_width(png_, info_));
    picture_.height = static_cast<int>(png_get_image_height(png_, info_));
    picture_.channels = png_get_channels(png_, info_);
    picture_.kind = png_get_bit_depth(png_, info_) == 16 ? words_kind : bytes_kind;
    const bool has_alpha = picture_.channels == 2 || picture_.channels == 4;
    picture_.alpha_channel = has_alpha ? picture_.channels - 1 : -1;
    if (has_alpha && alpha_ == StoredAlpha::kept_apart) picture_.put("oiio:UnassociatedAlpha", 1);
    picture_.full_width = picture_.width;
    picture_.full_height = picture_.height;
  }

  bool multiplies() const { return picture_.alpha_channel >= 0 && alpha_ == StoredAlpha::multiplied; }
  std::size_t pixels() const {
    return static_cast<std::size_t>(picture_.width) * static_cast<std::size_t>(picture_.height);
  }

  /// A PNG is decoded once, from its first row to its last.
  bool decode_to(std::uint8_t* to) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    for (int pass = 0; pass < passes_; ++pass)
      for (int y = 0; y < picture_.height; ++y)
        png_read_row(png_, to + static_cast<std::size_t>(y) * png_get_rowbytes(png_, info_), nullptr);
    return true;
  }
  bool decode() {
    std::vector<std::uint8_t> all(static_cast<std::size_t>(picture_.height) * png_get_rowbytes(png_, info_));
    if (!decode_to(all.data())) return false;
    decoded_ = std::move(all);
    if (!multiplies()) return true;
    if (picture_.kind == bytes_kind) {
      multiply(decoded_.data(), pixels());
    } else {
      multiply(reinterpret_cast<std::uint16_t*>(decoded_.data()), pixels());
    }
    return true;
  }

  template <class Number>
  void multiply(Number* pixel, std::size_t count) const {
    for (; count-- > 0; pixel += picture_.channels)
      for (int channel = 0; channel < picture_.alpha_channel; ++channel)
        pixel[channel] = static_cast<Number>(static_cast<unsigned>(pixel[channel]) * pixel[picture_.alpha_channel] /
                                             std::numeric_limits<Number>::max());
  }

  template <class Number>
  void bring_to_one(const Number* from, std::size_t first, std::size_t count, int channels, float* to) const {
    constexpr float scale = 1.f / static_cast<float>(std::numeric_limits<Number>::max());
    from += first * static_cast<std::size_t>(picture_.channels);
    for (; count-- > 0; from += picture_.channels)
      for (int channel = 0; channel < channels; ++channel) *to++ = static_cast<float>(from[channel]) * scale;
  }

  std::string_view bytes_;  ///< what libpng has not yet taken
  StoredAlpha alpha_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  int passes_ = 1;
  StoredPicture picture_;
  std::vector<std::uint8_t> decoded_;
  std::string complaint_;
};

int orientation_of(std::string_view png) {
  if (const auto chunks = png_chunks(png))
    for (const PngChunk& chunk : *chunks)
      if (chunk.type == "eXIf") return exif_orientation(chunk.data);
  return 1;
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

OpenedPicture open_png_bytes(std::string_view bytes, StoredAlpha alpha) {
  auto reader = std::make_unique<PngReader>(bytes, alpha, orientation_of(bytes));
  if (!reader->open()) return {nullptr, reader->complaint()};
  return {std::move(reader), {}};
}

}  // namespace wheatstone
