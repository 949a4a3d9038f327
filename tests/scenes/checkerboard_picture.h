#pragma once

// Photographs of a checkerboard by a camera that is known exactly.

#include <array>
#include <cmath>
#include <cstdint>

#include "wheatstone/image/image.h"

namespace wheatstone {

struct CheckerboardView {
  int columns = 7, rows = 5;  ///< inner corners
  double square_mm = 20;
  int width = 400, height = 300;  ///< of the picture
  double focal_px = 420;
  double distance_mm = 330;
  double tilt_x = 0, tilt_y = 0;  ///< of the board, in radians
  double camera_mm = 0;           ///< how far the camera stands to the right
};

/// The board before a camera without lens distortion; three rays a side of every pixel.
inline Image<Rgb8> checkerboard_picture(const CheckerboardView& view) {
  constexpr int finer = 3;
  const std::array<double, 3> across{std::cos(view.tilt_y), 0, -std::sin(view.tilt_y)};
  const std::array<double, 3> down{std::sin(view.tilt_x) * std::sin(view.tilt_y), std::cos(view.tilt_x),
                                   std::sin(view.tilt_x) * std::cos(view.tilt_y)};
  const std::array<double, 3> normal{across[1] * down[2] - across[2] * down[1],
                                     across[2] * down[0] - across[0] * down[2],
                                     across[0] * down[1] - across[1] * down[0]};
  Image<Rgb8> picture(view.width, view.height);
  for (int y = 0; y < view.height; ++y) {
    for (int x = 0; x < view.width; ++x) {
      double sum = 0;
      for (int ray = 0; ray < finer * finer; ++ray) {
        const double rx = (x + (ray % finer + 0.5) / finer - view.width / 2.0) / view.focal_px;
        const double ry = (y + (ray / finer + 0.5) / finer - view.height / 2.0) / view.focal_px;
        const double along = (-view.camera_mm * normal[0] + view.distance_mm * normal[2]) /
                             (rx * normal[0] + ry * normal[1] + normal[2]);
        const double px = view.camera_mm + along * rx, py = along * ry, pz = along - view.distance_mm;
        const double u = (px * across[0] + py * across[1] + pz * across[2]) / view.square_mm + (view.columns + 1) / 2.0;
        const double v = (px * down[0] + py * down[1] + pz * down[2]) / view.square_mm + (view.rows + 1) / 2.0;
        const bool board = u > 0 && v > 0 && u < view.columns + 1 && v < view.rows + 1;
        sum += !board ? 230 : (static_cast<int>(u) + static_cast<int>(v)) % 2 == 0 ? 25 : 230;
      }
      const auto grey = static_cast<std::uint8_t>(std::lround(sum / (finer * finer)));
      picture(x, y) = {grey, grey, grey};
    }
  }
  return picture;
}

/// Tilts about x and y, in radians, that together determine a camera.
constexpr std::array<std::array<double, 2>, 6> checkerboard_tilts{
    {{0.5, 0}, {-0.5, 0.1}, {0.1, 0.5}, {0, -0.5}, {0.35, 0.35}, {-0.3, -0.4}}};

}  // namespace wheatstone
