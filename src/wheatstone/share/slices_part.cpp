#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "wheatstone/files/deflate.h"
#include "wheatstone/share/slices_part_internal.h"

namespace wheatstone {
namespace {

/// The bytes of one channel, and those that are left once what neighbours let expect is taken off.
class Plane {
 public:
  Plane(int width, int height) : codes_(width, height) {}
  std::uint8_t& at(int x, int y) { return codes_(x, y); }

  void append_to(std::vector<std::uint8_t>& bytes) const {
    for (int y = 0; y < codes_.height(); ++y)
      for (int x = 0; x < codes_.width(); ++x) {
        const int left = x > 0 ? codes_(x - 1, y) : 0, up = y > 0 ? codes_(x, y - 1) : 0,
                  between = x > 0 && y > 0 ? codes_(x - 1, y - 1) : 0;
        const int expected = std::clamp(left + up - between, std::min(left, up), std::max(left, up));
        bytes.push_back(static_cast<std::uint8_t>(codes_(x, y) - expected));
      }
  }

 private:
  Image<std::uint8_t> codes_;
};

/// Light as its code.
class Encoder {
 public:
  explicit Encoder(const LightCode& code)
      : code_(code),
        steps_an_octave_(code.most > code.least ? static_cast<float>(code.steps - 1) / std::log2(code.most / code.least)
                                                : 0) {}

  std::uint8_t operator()(float light) const {
    if (!(light > 0)) return 0;
    const long step = std::lround(std::log2(light / code_.least) * steps_an_octave_) + 1;
    return static_cast<std::uint8_t>(std::clamp(step, 0L, static_cast<long>(code_.steps)));
  }

 private:
  LightCode code_;
  float steps_an_octave_;
};

/// A number as the first 16 bits of its float, rounded: an exponent and seven bits of the mantissa.
std::uint32_t short_float(float value) { return (std::bit_cast<std::uint32_t>(value) + 0x8000u) >> 16; }

std::uint8_t level(float share) { return static_cast<std::uint8_t>(std::lround(std::clamp(share, 0.f, 1.f) * 255)); }

}  // namespace

PagePart slice_part(std::string name, const Slice& slice, SliceChannels channels, bool has_alpha,
                    const LightCode& code) {
  const int width = slice.pixels.width(), height = slice.pixels.height();
  const int coloured = channels == SliceChannels::light ? 1 : channels == SliceChannels::share ? 2 : 3;
  std::vector<Plane> planes(static_cast<std::size_t>(coloured + (has_alpha ? 1 : 0)), Plane(width, height));
  const Encoder encode(code);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const LinearRgba& pixel = slice.pixels(x, y);
      const std::uint8_t light = encode(pixel.r);
      planes[0].at(x, y) = light;
      if (channels == SliceChannels::colours) {
        // The steps between the channels are the same wherever the colour is.
        planes[1].at(x, y) = static_cast<std::uint8_t>(encode(pixel.g) - light);
        planes[2].at(x, y) = static_cast<std::uint8_t>(encode(pixel.b) - light);
      } else if (light > 0 && channels == SliceChannels::share) {
        planes[1].at(x, y) = level(pixel.g / pixel.r);
      } else if (light > 0 && channels == SliceChannels::mean) {
        const std::uint32_t mean = short_float(pixel.g / pixel.r);
        planes[1].at(x, y) = static_cast<std::uint8_t>(mean >> 8);
        planes[2].at(x, y) = static_cast<std::uint8_t>(mean);
      }
      if (has_alpha) planes.back().at(x, y) = level(pixel.a);
    }
  std::vector<std::uint8_t> bytes;
  bytes.reserve(planes.size() * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (const Plane& plane : planes) plane.append_to(bytes);
  constexpr int effort = 6;
  return {std::move(name), deflated(bytes, effort)};
}

SliceStack halved(const SliceStack& stack) {
  SliceStack half = stack;
  half.width = (stack.width + 1) / 2;
  half.height = (stack.height + 1) / 2;
  for (Slice& slice : half.slices) {
    const Slice whole = std::exchange(slice, {});
    const auto half_below = [](int edge) { return edge >> 1; };
    slice.parallax_px = whole.parallax_px / 2;
    slice.left = half_below(whole.left);
    slice.top = half_below(whole.top);
    slice.pixels = Image<LinearRgba>(half_below(whole.left + whole.pixels.width() + 1) - slice.left,
                                     half_below(whole.top + whole.pixels.height() + 1) - slice.top);
    for (int y = 0; y < whole.pixels.height(); ++y)
      for (int x = 0; x < whole.pixels.width(); ++x) {
        const LinearRgba& from = whole.pixels(x, y);
        LinearRgba& to = slice.pixels(half_below(whole.left + x) - slice.left, half_below(whole.top + y) - slice.top);
        to = {to.r + from.r / 4, to.g + from.g / 4, to.b + from.b / 4, to.a + from.a / 4};
      }
  }
  return half;
}

}  // namespace wheatstone
