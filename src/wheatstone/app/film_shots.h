#pragma once

#include <cstdint>
#include <filesystem>
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

/// What was made by hand for a frame.
struct MapsKey {
  std::int64_t frame = 0;  ///< counted from 0
  FrameMaps maps;
};

/// A part of a film that is a scene, and how it is painted.
struct FilmShot {
  std::int64_t begin = 0;  ///< frame, counted from 0
  Style style;
  std::optional<float> depth_budget;         ///< as RotoscopeOptions
  std::optional<float> zero_parallax_px;     ///< as RotoscopeOptions
  std::vector<MovingParameter> moving = {};  ///< each instead of the member above
  /// From `begin` on, in which the shot before it is painted, too, and fades out; 0: a cut. The first shot has none.
  std::int64_t dissolve_frames = 0;
  std::vector<MapsKey> maps = {};  ///< in the order of their frames
};

/// How a frame of a shot is painted that is shown at `at_s`; not its first one.
RotoscopeOptions options_of_shot(const RotoscopeOptions& options, const FilmShot& shot, double at_s);

/// How a frame, counted from 0 and shown at `at_s`, is painted. Shots are in order, and the first one begins with frame
/// 0; where there are none, `options` say it.
RotoscopeOptions options_of_frame(const RotoscopeOptions& options, std::span<const FilmShot> shots, std::int64_t frame,
                                  double at_s);

/// A frame of two shots.
struct Dissolve {
  const FilmShot* outgoing = nullptr;
  float share = 0;  ///< of the shot that has begun, 0..1
};

/// None where the frame belongs to one shot alone.
std::optional<Dissolve> dissolve_at(std::span<const FilmShot> shots, std::int64_t frame);

/// Where shots begin that nothing is carried into: with a cut.
std::vector<std::int64_t> cuts_of(std::span<const FilmShot> shots);

/// Whether a shot begins with the frame.
bool begins_shot(std::span<const FilmShot> shots, std::int64_t frame);

/// Whether something was made by hand for the frame.
bool has_maps(std::span<const FilmShot> shots, std::int64_t frame);

}  // namespace wheatstone
