#pragma once

#include <algorithm>
#include <array>
#include <cmath>

namespace wheatstone {

// Light on a surface that faces its light source. The sum is 1, except where the lamp shines along the line of sight
// and adds to it.
inline constexpr float light_all_around = 0.13f, light_of_camera = 0.25f, light_of_lamp = 0.72f;

/// The direction to the lamp: right, down and forward as the camera sees it. Not of length 1.
inline constexpr std::array<float, 3> direction_to_lamp{-0.55f, -0.7f, -0.45f};

/// The light on a sphere at a place of its disc, as a multiple of its mean over the disc, so that spheres are as bright
/// as discs. `right` and `down` are the place's distances from the middle, in radii of at most 1 together. Discs of a
/// few pixels show the mean: what light their pixels' middles meet would be chance. gather_splats.comp has the same.
inline float light_on_sphere(float right, float down, float radius_px) {
  // Of a sphere lit from an angle α beside the camera, Lambert's law gives 2/(3π)·(sin α + (π − α)·cos α) of the light.
  constexpr float mean = 0.5736f;
  constexpr float flat_px = 1.5f, round_px = 4;
  const float roundness = std::clamp((radius_px - flat_px) / (round_px - flat_px), 0.f, 1.f);
  if (roundness == 0) return 1;
  const float towards = std::sqrt(std::max(1 - right * right - down * down, 0.f));
  const auto& [lamp_right, lamp_down, lamp_forward] = direction_to_lamp;
  constexpr float lamp_length = 0.9975f;
  const float to_lamp = (lamp_right * right + lamp_down * down - lamp_forward * towards) / lamp_length;
  const float light = light_all_around + light_of_camera * towards + light_of_lamp * std::max(to_lamp, 0.f);
  return 1 + roundness * (light / mean - 1);
}

}  // namespace wheatstone
