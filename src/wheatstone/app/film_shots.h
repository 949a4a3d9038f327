#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/app/rotoscope.h"

namespace wheatstone {

/// A number that may move within a shot, because it changes all marks of a frame, or how they are shown. What only new
/// strokes are planned with would come late, one stroke after the other.
struct MovableParameter {
  std::string_view name;
  float (*get)(const RotoscopeOptions&);
  void (*set)(RotoscopeOptions&, float);
};

/// Those of the style and of the depth.
std::span<const MovableParameter> movable_parameters();

/// None where there is none of this name.
const MovableParameter* find_movable_parameter(std::string_view name);

/// The value of a number at a moment of the film.
struct ParameterKey {
  double at_s = 0;
  float value = 0;
};

/// A number of a shot that moves: linearly in time from key to key. It has the value of its first key before that, and
/// of its last key after that.
struct MovingParameter {
  std::string name;                ///< of a movable parameter
  std::vector<ParameterKey> keys;  ///< at least one, in the order of their times
};

/// A part of a film that is a scene, and how it is painted.
struct FilmShot {
  std::int64_t begin = 0;  ///< frame, counted from 0
  Style style;
  std::optional<float> depth_budget;         ///< as RotoscopeOptions
  std::optional<float> zero_parallax_px;     ///< as RotoscopeOptions
  std::vector<MovingParameter> moving = {};  ///< each instead of the member above
};

/// How a frame, counted from 0 and shown at `at_s`, is painted. Shots are in order, and the first one begins with frame
/// 0; where there are none, `options` say it.
RotoscopeOptions options_of_frame(const RotoscopeOptions& options, std::span<const FilmShot> shots, std::int64_t frame,
                                  double at_s);

/// Whether a shot begins with the frame.
bool begins_shot(std::span<const FilmShot> shots, std::int64_t frame);

}  // namespace wheatstone
