#include "wheatstone/strokes/jitter_internal.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "wheatstone/image/colour.h"
#include "wheatstone/random.h"

namespace wheatstone {
namespace {

/// An OKLab colour by its hue, an angle.
struct Tint {
  float lightness = 0, chroma = 0, hue = 0;
};

std::array<float, 3> linear_of(const Tint& tint) {
  return linear_from_oklab({tint.lightness, tint.chroma * std::cos(tint.hue), tint.chroma * std::sin(tint.hue)});
}

/// The most chroma that sRGB has at this lightness and hue.
float most_chroma(float lightness, float hue) {
  constexpr int halvings = 10;
  float inside = 0, outside = 0.4f;
  for (int i = 0; i < halvings; ++i) {
    const float middle = (inside + outside) / 2;
    const bool is_inside =
        std::ranges::all_of(linear_of({lightness, middle, hue}), [](float light) { return light >= 0 && light <= 1; });
    (is_inside ? inside : outside) = middle;
  }
  return inside;
}

}  // namespace

Rgb8 jittered(Rgb8 colour, const ColourJitter& jitter, std::uint64_t random) {
  if (jitter == ColourJitter{}) return colour;
  const auto unit = [&](std::uint64_t number) { return unit_float(hash_keys({random, number})); };
  const auto change = [&](float amount, std::uint64_t number) { return amount * (unit(number) - 0.5f); };
  constexpr float full_circle = 2 * std::numbers::pi_v<float>;

  std::array<float, 3> light{linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b)};
  if (jitter.hue != 0 || jitter.saturation != 0) {
    const Oklab own = oklab_from_linear(light);
    constexpr float least_chroma = 0.004f;  // a grey has no hue: it may get any
    Tint tint{own.lightness, std::hypot(own.a, own.b), std::atan2(own.b, own.a)};
    if (tint.chroma < least_chroma) tint.hue = full_circle * unit(6);
    tint.hue += full_circle * change(jitter.hue, 0);
    tint.chroma += change(jitter.saturation, 1) * most_chroma(tint.lightness, tint.hue);
    if (tint.chroma < 0) tint = {tint.lightness, -tint.chroma, tint.hue + full_circle / 2};
    tint.chroma = std::min(tint.chroma, most_chroma(tint.lightness, tint.hue));
    light = linear_of(tint);
  }
  std::array<float, 3> rgb{};
  std::ranges::transform(light, rgb.begin(), [](float linear) {
    return static_cast<float>(srgb_from_linear(std::clamp(linear, 0.f, 1.f))) / 255;
  });
  // The value of HSV is the largest channel.
  const float value = std::ranges::max(rgb), changed_value = std::clamp(value + change(jitter.value, 2), 0.f, 1.f);
  for (float& channel : rgb) channel = value > 0 ? channel * changed_value / value : changed_value;
  const auto level = [&](float channel, float amount, std::uint64_t number) {
    return static_cast<std::uint8_t>(std::lround(std::clamp(channel + change(amount, number), 0.f, 1.f) * 255));
  };
  return {level(rgb[0], jitter.red, 3), level(rgb[1], jitter.green, 4), level(rgb[2], jitter.blue, 5)};
}

}  // namespace wheatstone
