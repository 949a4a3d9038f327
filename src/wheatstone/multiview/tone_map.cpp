#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "wheatstone/image/colour.h"
#include "wheatstone/multiview/colour_bar.h"
#include "wheatstone/multiview/tone_map_internal.h"

namespace wheatstone {
namespace {

Oklab oklab_of(Rgb8 colour) {
  return oklab_from_linear({linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b)});
}

/// The colour of this lightness and hue, with as much of its chroma as sRGB has: nothing is clipped.
Rgb8 shown_as(const Oklab& colour) {
  float share = 1;
  for (int step = 0; step < 50; ++step, share *= 0.95f) {
    const std::array<float, 3> light = linear_from_oklab({colour.lightness, colour.a * share, colour.b * share});
    if (std::ranges::all_of(light, [](float channel) { return channel > -1e-4f && channel < 1.0001f; }))
      return {srgb_from_linear(light[0]), srgb_from_linear(light[1]), srgb_from_linear(light[2])};
  }
  const std::uint8_t grey = srgb_from_linear(linear_from_oklab({colour.lightness, 0, 0})[1]);
  return {grey, grey, grey};
}

/// A hue at a brightness 0..1: as saturated as the hue is up to its own lightness, and paler beyond.
Rgb8 shaded(const Oklab& hue, float brightness) {
  constexpr float palest = 0.97f;  // so that the brightest parts keep their hue
  constexpr float chroma_left = 0.3f;
  const float lightness = palest * brightness;
  const float beyond = std::clamp((lightness - hue.lightness) / (palest - hue.lightness), 0.f, 1.f);
  const float chroma = std::min(lightness / hue.lightness, 1.f) * (1 - (1 - chroma_left) * beyond);
  return shown_as({lightness, hue.a * chroma, hue.b * chroma});
}

Oklab mixed(const Oklab& from, const Oklab& to, float share) {
  return {std::lerp(from.lightness, to.lightness, share), std::lerp(from.a, to.a, share),
          std::lerp(from.b, to.b, share)};
}

/// A column's mean seldom comes near either end of the ramp: what lies between goes farther towards them.
float settled_hue(float share) {
  const float stretched = std::clamp((share - 0.15f) / 0.6f, 0.f, 1.f);
  return stretched * stretched * (3 - 2 * stretched);
}

std::int32_t key_of(Rgb8 colour) { return colour.r + 256 * colour.g + 65536 * colour.b; }

constexpr float softening = 30;  // asinh becomes logarithmic at a thirtieth of the way

/// Brightness 0..1 of a share 0..1 of the way between the limits. `least_over_most` is for the logarithm.
float brightness_of(float share, Stretch stretch, float least_over_most) {
  switch (stretch) {
    case Stretch::asinh:
      return std::asinh(softening * share) / std::asinh(softening);
    case Stretch::log:
      return std::log(std::max(share, least_over_most) / least_over_most) / -std::log(least_over_most);
    default:
      return share;
  }
}

void fill_colours(const ToneSettings& settings, ToneMap& map) {
  if (settings.shown == Shown::ramp) {
    map.hues = 64;
    const Oklab cold = oklab_of(settings.cold);
    const Oklab hot = oklab_of(settings.hot);
    const bool named = !settings.colour_map.empty();
    const std::array<Rgb8, 256> palette = named ? colour_map(settings.colour_map) : std::array<Rgb8, 256>{};
    for (int brightness = 0; brightness < ToneMap::brightnesses; ++brightness)
      for (int hue = 0; hue < map.hues; ++hue) {
        const float share = settled_hue(static_cast<float>(hue) / static_cast<float>(map.hues - 1));
        const Oklab colour =
            named ? oklab_of(palette[static_cast<std::size_t>(std::lround(share * 255))]) : mixed(cold, hot, share);
        const Oklab visible{std::max(colour.lightness, 0.1f), colour.a, colour.b};
        map.colours.push_back(key_of(shaded(visible, static_cast<float>(brightness) / (ToneMap::brightnesses - 1))));
      }
    return;
  }
  for (const Rgb8 colour : colour_map(settings.colour_map.empty() ? "inferno" : settings.colour_map))
    map.colours.push_back(key_of(colour));
}

/// The stretch by the bits of numbers from 2^−25 to 2.
void fill_stretch(const ToneSettings& settings, ToneMap& map) {
  // With a logarithm, the table begins at 0, not at the lower limit.
  const bool logarithmic = settings.stretch == Stretch::log;
  const float range = settings.most - (logarithmic ? 0 : settings.least);
  map.scale = range > 0 ? 1 / range : 1;
  map.offset = logarithmic ? 0 : -settings.least * map.scale;
  const float least_over_most = logarithmic ? std::min(settings.least / settings.most, 0.999f) : 0;
  for (int i = 0; i < ToneMap::stretch_size; ++i) {
    const auto bits = static_cast<std::uint32_t>(i + ToneMap::first_index) << ToneMap::index_shift;
    const float middle = std::bit_cast<float>(bits + (1u << (ToneMap::index_shift - 1)));
    // No light at all is dark.
    const float brightness =
        i == 0 ? 0 : std::clamp(brightness_of(std::min(middle, 1.f), settings.stretch, least_over_most), 0.f, 1.f);
    map.stretch.push_back(static_cast<std::int32_t>(std::lround(brightness * (ToneMap::brightnesses - 1))) * map.hues);
    // As an sRGB code is, so that the hue of colours is kept in linear light.
    map.linear_stretch.push_back(brightness <= 0.04045f ? brightness / 12.92f
                                                        : std::pow((brightness + 0.055f) / 1.055f, 2.4f));
  }
}

}  // namespace

ToneMap::ToneMap(const ToneSettings& settings)
    : look(settings.look),
      shown(settings.shown),
      exposure(settings.exposure),
      bounded(settings.stretch == Stretch::linear) {
  for (int i = 0; i < table_size; ++i)
    table.push_back(srgb_from_linear(static_cast<float>(i) / static_cast<float>(table_size - 1)));
  if (look == Look::thesis) return;
  fill_colours(settings, *this);
  fill_stretch(settings, *this);
}

Rgb8 ToneMap::operator()(float first, float second, float third) const {
  const auto byte_of = [&](float linear) {
    const auto entry = std::clamp(std::lround(linear * (table_size - 1)), 0L, table_size - 1L);
    return static_cast<std::uint8_t>(table[static_cast<std::size_t>(entry)]);
  };
  if (look == Look::thesis) {
    const auto toned = [&](float light) {
      const float exposed = std::max(light * exposure, 0.f);
      return byte_of(bounded ? std::min(exposed, 1.f) : exposed / (exposed + 1));
    };
    return {toned(first), toned(second), toned(third)};
  }
  constexpr float nothing = 1e-30f;
  const auto index_of = [&](float value) {
    const auto bits = std::bit_cast<std::int32_t>(std::max(value * scale + offset, 0.f));
    return static_cast<std::size_t>(std::clamp((bits >> index_shift) - first_index, 0, stretch_size - 1));
  };
  if (shown == Shown::colours) {
    const float most = std::max({first, second, third});
    const float factor = linear_stretch[index_of(most)] / std::max(most, nothing);
    return {byte_of(first * factor), byte_of(second * factor), byte_of(third * factor)};
  }
  if (!(first > nothing)) return {};
  const float mean = second / first;
  const float hue = std::clamp(mean * static_cast<float>(hues - 1), 0.f, static_cast<float>(hues - 1));
  const std::size_t entry = static_cast<std::size_t>(stretch[index_of(shown == Shown::mean ? mean : first)]) +
                            static_cast<std::size_t>(hues > 1 ? std::lround(hue) : 0);
  const std::int32_t colour = colours[entry];
  return {static_cast<std::uint8_t>(colour & 255), static_cast<std::uint8_t>(colour >> 8 & 255),
          static_cast<std::uint8_t>(colour >> 16)};
}

Image<Rgb8> colour_bar(const ToneSettings& settings, int width, int height) {
  const ToneMap tone(settings);
  Image<Rgb8> bar(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const float value = value_at(settings, (static_cast<float>(x) + 0.5f) / static_cast<float>(width));
      const float hue = 1 - (static_cast<float>(y) + 0.5f) / static_cast<float>(height);
      bar(x, y) = settings.shown == Shown::mean ? tone(1, value, 0) : tone(value, value * hue, 0);
    }
  return bar;
}

float value_at(const ToneSettings& settings, float brightness) {
  switch (settings.stretch) {
    case Stretch::asinh:
      return std::lerp(settings.least, settings.most, std::sinh(brightness * std::asinh(softening)) / softening);
    case Stretch::log:
      return settings.least * std::pow(settings.most / settings.least, brightness);
    default:
      return std::lerp(settings.least, settings.most, brightness);
  }
}

float brightness_at(const ToneSettings& settings, float value) {
  const bool logarithmic = settings.stretch == Stretch::log;
  const float least = logarithmic ? 0 : settings.least;
  return brightness_of((value - least) / (settings.most - least), settings.stretch, settings.least / settings.most);
}

}  // namespace wheatstone
