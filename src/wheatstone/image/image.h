#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace wheatstone {

/// An sRGB-encoded colour, 0..255 a channel: the papers' thresholds are in these units.
struct Rgb8 {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb8&, const Rgb8&) = default;
};

/// The same with 16 bits a channel, 0..65535: what films of ten bits are read to, and drawn for.
struct Rgb16 {
  std::uint16_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb16&, const Rgb16&) = default;
};

/// Of one level of 8 bits, in Rgb16.
inline constexpr int deep_level = 257;

/// Borrowed pixels, row by row, row 0 at the top; pixel (x, y) covers [x, x+1) × [y, y+1). Never owns, never null
/// unless empty. `ImageView<const Pixel>` only reads. `stride` counts pixels from one row to the next.
template <class Pixel>
class ImageView {
 public:
  ImageView() = default;
  ImageView(Pixel* data, int width, int height, std::ptrdiff_t stride)
      : data_(data), width_(width), height_(height), stride_(stride) {}
  template <class Other>
  ImageView(const ImageView<Other>& other) requires std::is_same_v<Pixel, const Other>
      : ImageView(other.data(), other.width(), other.height(), other.stride()) {}

  int width() const { return width_; }
  int height() const { return height_; }
  std::ptrdiff_t stride() const { return stride_; }
  bool empty() const { return width_ == 0 || height_ == 0; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  Pixel* data() const { return data_; }

  std::span<Pixel> row(int y) const {
    assert(y >= 0 && y < height_);
    return {data_ + y * stride_, static_cast<std::size_t>(width_)};
  }
  Pixel& operator()(int x, int y) const {
    assert(contains(x, y));
    return data_[y * stride_ + x];
  }

 private:
  Pixel* data_ = nullptr;
  int width_ = 0;
  int height_ = 0;
  std::ptrdiff_t stride_ = 0;
};

/// Owned pixels without gaps between the rows. Copying copies the pixels.
template <class Pixel>
class Image {
 public:
  Image() = default;
  Image(int width, int height, Pixel fill = {})
      : pixels_(static_cast<std::size_t>(width) * height, fill), width_(width), height_(height) {}

  int width() const { return width_; }
  int height() const { return height_; }
  bool empty() const { return pixels_.empty(); }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }

  std::span<Pixel> pixels() { return pixels_; }
  std::span<const Pixel> pixels() const { return pixels_; }
  std::span<Pixel> row(int y) { return view().row(y); }
  std::span<const Pixel> row(int y) const { return view().row(y); }
  Pixel& operator()(int x, int y) { return view()(x, y); }
  const Pixel& operator()(int x, int y) const { return view()(x, y); }

  ImageView<Pixel> view() { return {pixels_.data(), width_, height_, width_}; }
  ImageView<const Pixel> view() const { return {pixels_.data(), width_, height_, width_}; }
  operator ImageView<Pixel>() { return view(); }
  operator ImageView<const Pixel>() const { return view(); }

  friend bool operator==(const Image&, const Image&) = default;

 private:
  std::vector<Pixel> pixels_;
  int width_ = 0;
  int height_ = 0;
};

/// In pixels.
struct PictureSize {
  int width = 0, height = 0;
  friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// True where two images or views have the same width and height.
template <class A, class B>
bool same_size(const A& a, const B& b) {
  return a.width() == b.width() && a.height() == b.height();
}

}  // namespace wheatstone
