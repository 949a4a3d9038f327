#pragma once

// A small pair with known truth, for the painting room's tests: a textured far wall and a nearer square before it.

#include <algorithm>
#include <cmath>

#include "wheatstone/random.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::test_scene {

inline constexpr int width = 160, height = 120;
inline constexpr float wall_disparity = 4, square_disparity = 16;
inline constexpr int square_left = 60, square_right = 110, square_top = 30, square_bottom = 90;

inline bool in_square(float x_left_view, int y) {
  return x_left_view >= square_left && x_left_view < square_right && y >= square_top && y < square_bottom;
}

/// A surface's colour at a place on it: smooth waves with some grain, so that strokes have something to follow.
inline Rgb8 colour_at(float x, int y, bool square) {
  const float wave = 0.5f + 0.5f * std::sin(0.21f * x + 0.13f * static_cast<float>(y));
  const float grain = unit_float(hash_keys({static_cast<std::uint64_t>(x + 1000), static_cast<std::uint64_t>(y)}));
  const auto level = [&](float base, float swing) {
    return static_cast<std::uint8_t>(base + swing * wave + 20 * grain);
  };
  return square ? Rgb8{level(150, 80), level(30, 40), level(20, 30)}
                : Rgb8{level(30, 60), level(60, 120), level(120, 100)};
}

inline StereoPair photographs() {
  StereoPair pair{Image<Rgb8>(width, height), Image<Rgb8>(width, height)};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const auto fx = static_cast<float>(x);
      pair.left(x, y) = colour_at(fx, y, in_square(fx, y));
      const bool square = in_square(fx + square_disparity, y);
      pair.right(x, y) = colour_at(fx + (square ? square_disparity : wall_disparity), y, square);
    }
  }
  return pair;
}

inline StereoGeometry geometry() {
  Image<float> left(width, height, wall_disparity), right(width, height, wall_disparity);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (in_square(static_cast<float>(x), y)) left(x, y) = square_disparity;
      if (in_square(static_cast<float>(x) + square_disparity, y)) right(x, y) = square_disparity;
    }
  }
  return geometry_from_both(left, right, {.least_occlusion_px = 1});
}

/// The scene as two cameras take it: each eye has grain of its own, and the right camera's picture is a little lighter.
inline StereoPair as_photographed() {
  StereoPair pair = photographs();
  std::uint64_t eye = 0;
  for (Image<Rgb8>* picture : {&pair.left, &pair.right}) {
    ++eye;
    for (std::size_t i = 0; i < picture->pixels().size(); ++i) {
      const float gain = eye == 2 ? 1.06f : 1.f;
      const auto grainy = [&](std::uint8_t level, std::uint64_t channel) {
        const float noise = 16 * (unit_float(hash_keys({eye, i, channel})) - 0.5f);
        return static_cast<std::uint8_t>(std::clamp(gain * static_cast<float>(level) + noise, 0.f, 255.f));
      };
      Rgb8& pixel = picture->pixels()[i];
      pixel = {grainy(pixel.r, 0), grainy(pixel.g, 1), grainy(pixel.b, 2)};
    }
  }
  return pair;
}

}  // namespace wheatstone::test_scene
