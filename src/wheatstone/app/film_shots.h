#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/app/rotoscope.h"

namespace wheatstone {

/// A part of a film that is a scene, and how it is painted.
struct FilmShot {
  std::int64_t begin = 0;  ///< frame, counted from 0
  Style style;
  std::optional<float> depth_budget;      ///< as RotoscopeOptions
  std::optional<float> zero_parallax_px;  ///< as RotoscopeOptions
};

/// How a frame, counted from 0, is painted. Shots are in order, and the first one begins with frame 0; where there are
/// none, `options` say it.
RotoscopeOptions options_of_frame(const RotoscopeOptions& options, std::span<const FilmShot> shots, std::int64_t frame);

/// Whether a shot begins with the frame.
bool begins_shot(std::span<const FilmShot> shots, std::int64_t frame);

}  // namespace wheatstone
