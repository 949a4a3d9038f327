#include "wheatstone/strokes/jitter_internal.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/random.h"

namespace wheatstone {
namespace {

/// Red, green and blue, or hue, saturation and value, each 0..1.
struct Triple {
  float a, b, c;
};

Triple hsv_from_rgb(const Triple& rgb) {
  const float high = std::max({rgb.a, rgb.b, rgb.c}), low = std::min({rgb.a, rgb.b, rgb.c});
  const float chroma = high - low;
  if (chroma <= 0) return {0, 0, high};
  float sixth = 0;
  if (high == rgb.a) {
    sixth = (rgb.b - rgb.c) / chroma;
  } else if (high == rgb.b) {
    sixth = 2 + (rgb.c - rgb.a) / chroma;
  } else {
    sixth = 4 + (rgb.a - rgb.b) / chroma;
  }
  return {sixth / 6 - std::floor(sixth / 6), chroma / high, high};
}

Triple rgb_from_hsv(const Triple& hsv) {
  const auto channel = [&](float offset) {
    const float k = std::fmod(offset + hsv.a * 6, 6.f);
    return hsv.c - hsv.c * hsv.b * std::clamp(std::min(k, 4 - k), 0.f, 1.f);
  };
  return {channel(5), channel(3), channel(1)};
}

}  // namespace

Rgb8 jittered(Rgb8 colour, const ColourJitter& jitter, std::uint64_t random) {
  if (jitter == ColourJitter{}) return colour;
  const auto change = [&](float amount, std::uint64_t number) {
    return amount * (unit_float(hash_keys({random, number})) - 0.5f);
  };
  const auto clamped = [](float value) { return std::clamp(value, 0.f, 1.f); };

  Triple hsv = hsv_from_rgb(
      {static_cast<float>(colour.r) / 255, static_cast<float>(colour.g) / 255, static_cast<float>(colour.b) / 255});
  hsv.a += change(jitter.hue, 0);
  hsv.a -= std::floor(hsv.a);
  hsv.b = clamped(hsv.b + change(jitter.saturation, 1));
  hsv.c = clamped(hsv.c + change(jitter.value, 2));
  const Triple rgb = rgb_from_hsv(hsv);
  const auto byte = [&](float value) { return static_cast<std::uint8_t>(std::lround(clamped(value) * 255)); };
  return {byte(rgb.a + change(jitter.red, 3)), byte(rgb.b + change(jitter.green, 4)),
          byte(rgb.c + change(jitter.blue, 5))};
}

}  // namespace wheatstone
