#include "wheatstone/synthetic/synthetic_still.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/synthetic/synthetic_still_view_internal.h"

namespace wheatstone {
namespace still {
namespace {

void check(const SyntheticStillOptions& options) {
  constexpr int least_px = 16, most_px = 16384;
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::wrong_usage, what); };
  if (options.width < least_px || options.height < least_px || options.width > most_px || options.height > most_px)
    refuse(fmt::format("size: is {}x{} pixels, expected {} to {} a side", options.width, options.height, least_px,
                       most_px));
  constexpr int most_aspect = 8;
  if (options.width > most_aspect * options.height || options.height > most_aspect * options.width)
    refuse(fmt::format("size: is {}x{} pixels, expected sides of at most 1:{}", options.width, options.height,
                       most_aspect));
  if (options.samples_a_side < 1 || options.samples_a_side > 8)
    refuse(fmt::format("{} samples a side of a pixel, expected 1 to 8", options.samples_a_side));
  const float least = options.least_disparity_px.value_or(0), largest = options.largest_disparity_px.value_or(least);
  const auto width = static_cast<float>(options.width);
  if (!std::isfinite(least) || !std::isfinite(largest) || largest < least || largest > width || least < -width)
    refuse(fmt::format("disparities from {} to {} px, expected least <= largest within the picture's width", least,
                       largest));
}

}  // namespace

Cameras make_cameras(const SyntheticStillOptions& options) {
  check(options);
  Cameras c{};
  c.width = options.width;
  c.height = options.height;
  c.focal_px = 0.5f * static_cast<float>(c.height) / half_height_of_view;
  const float sine = std::sin(camera_pitch_rad), cosine = std::cos(camera_pitch_rad);
  c.down = {0, -cosine, -sine};
  c.forward = {0, -sine, cosine};
  const float unit = static_cast<float>(c.width) / 640;
  const float largest = options.largest_disparity_px.value_or(45 * unit);
  const float least = options.least_disparity_px.value_or(std::min(6 * unit, largest));
  // The table at the picture's lower edge is nearest; the wall behind the table's far edge is farthest.
  const float nearest = cyclopean_eye.y / (sine + half_height_of_view * cosine), farthest = wall_z / cosine;
  const float product = (largest - least) / (1 / nearest - 1 / farthest);
  c.baseline = product / c.focal_px;
  c.shift_px = product / farthest - least + (options.converged ? 0.5f * (largest + least) : 0);
  return c;
}

}  // namespace still

SyntheticStill make_synthetic_still(const SyntheticStillOptions& options, const Progress& progress) {
  const still::Cameras cameras = still::make_cameras(options);
  const still::Scene scene = still::compose_still(options.seed);
  const still::View left(scene, cameras, left_eye), right(scene, cameras, right_eye);
  SyntheticStill result;
  const auto half = [&progress](double done_before) -> Progress {
    return [&progress, done_before](std::string_view step, double done) {
      report(progress, step, done_before + done / 2);
    };
  };
  SyntheticView of_left = still::render(left, options.samples_a_side, half(0));
  SyntheticView of_right = still::render(right, options.samples_a_side, half(0.5));
  result.pictures = {std::move(of_left.picture), std::move(of_right.picture)};
  result.geometry.left_disparity = std::move(of_left.disparity);
  result.geometry.right_disparity = std::move(of_right.disparity);
  result.geometry.left_occlusion = still::occlusion_of(cameras, left, right, result.geometry.left_disparity);
  result.geometry.right_occlusion = still::occlusion_of(cameras, right, left, result.geometry.right_disparity);
  return result;
}

SyntheticView make_synthetic_view(const SyntheticStillOptions& options, ViewPosition view, const Progress& progress) {
  const still::Cameras cameras = still::make_cameras(options);
  const still::Scene scene = still::compose_still(options.seed);
  return still::render(still::View(scene, cameras, view), options.samples_a_side, progress);
}

}  // namespace wheatstone
