#include "wheatstone/display/anaglyph.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "wheatstone/display/anaglyph_internal.h"
#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

using Matrix = AnaglyphMatrix;

struct Recipe {
  AnaglyphKind kind;
  Matrix left, right;
  float red_gamma = 1;  ///< of the result's red
};

constexpr std::array<float, 3> grey = luma_shares;  // of encoded values, as ffmpeg has it
constexpr std::array<float, 3> none{};
constexpr std::array<float, 3> red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1};

// Dubois' matrices for red-cyan: his values for sRGB displays in linear light, and those of 2001 that ffmpeg has.
constexpr Matrix red_cyan_left{{{0.437f, 0.449f, 0.164f}, {-0.062f, -0.062f, -0.024f}, {-0.048f, -0.050f, -0.017f}}};
constexpr Matrix red_cyan_right{{{-0.011f, -0.032f, -0.007f}, {0.377f, 0.761f, 0.009f}, {-0.026f, -0.093f, 1.234f}}};
constexpr Matrix arcd_left{{{0.456f, 0.500f, 0.176f}, {-0.040f, -0.038f, -0.016f}, {-0.015f, -0.021f, -0.005f}}};
constexpr Matrix arcd_right{{{-0.043f, -0.088f, -0.002f}, {0.378f, 0.734f, -0.018f}, {-0.072f, -0.113f, 1.226f}}};
constexpr Matrix green_magenta_left{
    {{-0.062f, -0.158f, -0.039f}, {0.284f, 0.668f, 0.143f}, {-0.015f, -0.027f, 0.021f}}};
constexpr Matrix green_magenta_right{{{0.529f, 0.705f, 0.024f}, {-0.016f, -0.015f, -0.065f}, {0.009f, 0.075f, 0.937f}}};
constexpr Matrix amber_blue_left{{{1.062f, -0.205f, 0.299f}, {-0.026f, 0.908f, 0.068f}, {-0.038f, -0.173f, 0.022f}}};
constexpr Matrix amber_blue_right{{{-0.016f, -0.123f, -0.017f}, {0.006f, 0.062f, -0.017f}, {0.094f, 0.185f, 0.911f}}};

constexpr std::array<Recipe, 18> recipes{{
    {{"red-cyan", "", "red-cyan", true}, red_cyan_left, red_cyan_right},
    {{"green-magenta", "", "green-magenta", true}, green_magenta_left, green_magenta_right},
    {{"amber-blue", "", "amber-blue", true}, amber_blue_left, amber_blue_right},
    {{"true", "arbg", "red-blue", false}, {{grey, none, none}}, {{none, none, grey}}},
    {{"grey", "arcg", "red-cyan", false}, {{grey, none, none}}, {{none, grey, grey}}},
    {{"half-colour", "arch", "red-cyan", false}, {{grey, none, none}}, {{none, green, blue}}},
    {{"colour", "arcc", "red-cyan", false}, {{red, none, none}}, {{none, green, blue}}},
    {{"optimised", "", "red-cyan", false}, {{{{0, 0.7f, 0.3f}}, none, none}}, {{none, green, blue}}, 1.5f},
    {{"red-cyan-encoded", "arcd", "red-cyan", false}, arcd_left, arcd_right},
    {{"green-magenta-encoded", "agmd", "green-magenta", false}, green_magenta_left, green_magenta_right},
    {{"amber-blue-encoded", "aybd", "amber-blue", false}, amber_blue_left, amber_blue_right},
    {{"green-magenta-grey", "agmg", "green-magenta", false}, {{none, grey, none}}, {{grey, none, grey}}},
    {{"green-magenta-half-colour", "agmh", "green-magenta", false}, {{none, grey, none}}, {{red, none, blue}}},
    {{"green-magenta-colour", "agmc", "green-magenta", false}, {{none, green, none}}, {{red, none, blue}}},
    {{"amber-blue-grey", "aybg", "amber-blue", false}, {{grey, grey, none}}, {{none, none, grey}}},
    {{"amber-blue-half-colour", "aybh", "amber-blue", false}, {{red, green, none}}, {{none, none, grey}}},
    {{"amber-blue-colour", "aybc", "amber-blue", false}, {{red, green, none}}, {{none, none, blue}}},
    {{"red-green-grey", "argg", "red-green", false}, {{grey, none, none}}, {{none, grey, none}}},
}};

constexpr auto kinds = [] {
  std::array<AnaglyphKind, recipes.size()> all{};
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = recipes[i].kind;
  return all;
}();

const Recipe& recipe_of(const AnaglyphKind& kind) {
  return *std::ranges::find(recipes, kind.name, [](const Recipe& recipe) { return recipe.kind.name; });
}

float row_times(const std::array<float, 3>& row, const std::array<float, 3>& colour) {
  return row[0] * colour[0] + row[1] * colour[1] + row[2] * colour[2];
}

float clipped(float value) { return std::clamp(value, 0.f, 1.f); }

Rgb8 mixed_in_linear_light(const Recipe& recipe, Rgb8 left, Rgb8 right) {
  const auto linear = [](Rgb8 c) {
    return std::array<float, 3>{linear_from_srgb(c.r), linear_from_srgb(c.g), linear_from_srgb(c.b)};
  };
  const std::array<float, 3> l = linear(left), r = linear(right);
  const auto channel = [&](std::size_t i) {
    return srgb_from_linear(clipped(row_times(recipe.left[i], l)) + clipped(row_times(recipe.right[i], r)));
  };
  return {channel(0), channel(1), channel(2)};
}

/// Of both eyes' sum of encoded values, 0..255.
std::uint8_t encoded_channel(float sum, float gamma) {
  float value = clipped(sum / 255);
  if (gamma != 1) value = std::pow(value, 1 / gamma);
  return static_cast<std::uint8_t>(255 * value + 0.5f);
}

/// The least number from which on a code value, or more, is made of it; codes do not fall where numbers rise.
template <class CodeOf>
float threshold_of(int code, CodeOf code_of) {
  constexpr float most = 1024;
  std::uint32_t below = 0, from = std::bit_cast<std::uint32_t>(most);
  while (from - below > 1) {
    const std::uint32_t middle = below + (from - below) / 2;
    (code_of(std::bit_cast<float>(middle)) >= code ? from : below) = middle;
  }
  return std::bit_cast<float>(from);
}

Rgb8 mixed_as_encoded(const Recipe& recipe, Rgb8 left, Rgb8 right) {
  const auto encoded = [](Rgb8 c) {
    return std::array<float, 3>{static_cast<float>(c.r), static_cast<float>(c.g), static_cast<float>(c.b)};
  };
  const std::array<float, 3> l = encoded(left), r = encoded(right);
  const auto channel = [&](std::size_t i, float gamma) {
    return encoded_channel(row_times(recipe.left[i], l) + row_times(recipe.right[i], r), gamma);
  };
  return {channel(0, recipe.red_gamma), channel(1, 1), channel(2, 1)};
}

template <class Mix>
Image<Rgb8> mixed(const StereoPairView& pair, Mix mix) {
  Image<Rgb8> result(pair.left.width(), pair.left.height());
  tbb::parallel_for(0, result.height(), [&](int y) {
    const auto left = pair.left.row(y), right = pair.right.row(y);
    std::ranges::transform(left, right, result.row(y).begin(), mix);
  });
  return result;
}

}  // namespace

std::span<const AnaglyphKind> anaglyph_kinds() { return kinds; }

Image<Rgb8> anaglyph(const StereoPairView& pair, const AnaglyphKind& kind) {
  const Recipe& recipe = recipe_of(kind);
  if (kind.linear_light)
    return mixed(pair, [&](Rgb8 left, Rgb8 right) { return mixed_in_linear_light(recipe, left, right); });
  return mixed(pair, [&](Rgb8 left, Rgb8 right) { return mixed_as_encoded(recipe, left, right); });
}

AnaglyphTables anaglyph_tables(const AnaglyphKind& kind) {
  const Recipe& recipe = recipe_of(kind);
  AnaglyphTables tables{.left = recipe.left, .right = recipe.right, .clips_eyes = kind.linear_light};
  for (int code = 0; code < 256; ++code)
    tables.light[static_cast<std::size_t>(code)] =
        kind.linear_light ? linear_from_srgb(static_cast<std::uint8_t>(code)) : static_cast<float>(code);
  for (std::size_t channel = 0; channel < 3; ++channel) {
    const auto code_of = [&, gamma = channel == 0 ? recipe.red_gamma : 1](float sum) {
      return kind.linear_light ? srgb_from_linear(sum) : encoded_channel(sum, gamma);
    };
    for (int code = 1; code < 256; ++code)
      tables.thresholds[channel][static_cast<std::size_t>(code - 1)] = threshold_of(code, code_of);
  }
  return tables;
}

Image<Rgb8> anaglyph(const StereoPairView& pair) { return anaglyph(pair, kinds.front()); }

}  // namespace wheatstone
