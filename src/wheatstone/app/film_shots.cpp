#include "wheatstone/app/film_shots.h"

#include <algorithm>
#include <array>
#include <iterator>

#include "wheatstone/files/struct_fields.h"

namespace wheatstone {
namespace {

constexpr std::array<MovableParameter, 6> movable{
    {{"depth-budget", [](const RotoscopeOptions& options) { return options.depth_budget.value_or(1.f); },
      [](RotoscopeOptions& options, float value) { options.depth_budget = value; }},
     {"zero-parallax", [](const RotoscopeOptions& options) { return options.zero_parallax_px.value_or(0.f); },
      [](RotoscopeOptions& options, float value) { options.zero_parallax_px = value; }},
     {"opacity", [](const RotoscopeOptions& options) { return options.style.opacity; },
      [](RotoscopeOptions& options, float value) { options.style.opacity = value; }},
     {"streaks", [](const RotoscopeOptions& options) { return options.style.brush.streaks; },
      [](RotoscopeOptions& options, float value) { options.style.brush.streaks = value; }},
     {"ridge", [](const RotoscopeOptions& options) { return options.style.brush.ridge; },
      [](RotoscopeOptions& options, float value) { options.style.brush.ridge = value; }},
     {"dry", [](const RotoscopeOptions& options) { return options.style.brush.dry; },
      [](RotoscopeOptions& options, float value) { options.style.brush.dry = value; }}}};

float value_at(const MovingParameter& parameter, double at_s) {
  const auto next = std::ranges::upper_bound(parameter.keys, at_s, {}, &ParameterKey::at_s);
  if (next == parameter.keys.begin()) return next->value;
  const ParameterKey& last = *std::prev(next);
  if (next == parameter.keys.end()) return last.value;
  const double share = (at_s - last.at_s) / (next->at_s - last.at_s);
  return static_cast<float>(last.value + share * (next->value - last.value));
}

std::span<const FilmShot>::iterator shot_of(std::span<const FilmShot> shots, std::int64_t frame) {
  return std::prev(std::ranges::upper_bound(shots, frame, {}, &FilmShot::begin));
}

/// What was made by hand for a frame of the shot. In a part of a film, several keys may have come to lie on it.
FrameMaps maps_at(const FilmShot& shot, std::int64_t frame) {
  FrameMaps maps;
  for (const MapsKey& key : shot.maps) {
    if (key.frame != frame) continue;
    if (!key.maps.detail.empty()) maps.detail = key.maps.detail;
    if (!key.maps.disparity.empty()) maps.disparity = key.maps.disparity;
  }
  return maps;
}

}  // namespace

std::span<const MovableParameter> movable_parameters() { return movable; }

const MovableParameter* find_movable_parameter(std::string_view name) {
  const auto* const found = std::ranges::find(movable, name, &MovableParameter::name);
  return found == movable.end() ? nullptr : found;
}

RotoscopeOptions options_of_shot(const RotoscopeOptions& options, const FilmShot& shot, double at_s) {
  static_assert(field_count<FilmShot>() == 7);
  RotoscopeOptions of_frame = options;
  of_frame.style = shot.style;
  of_frame.depth_budget = shot.depth_budget;
  of_frame.zero_parallax_px = shot.zero_parallax_px;
  of_frame.scene_begins = false;
  for (const MovingParameter& parameter : shot.moving) {
    find_movable_parameter(parameter.name)->set(of_frame, value_at(parameter, at_s));
    of_frame.eyes_move |= parameter.name == "depth-budget" || parameter.name == "zero-parallax";
  }
  return of_frame;
}

RotoscopeOptions options_of_frame(const RotoscopeOptions& options, std::span<const FilmShot> shots, std::int64_t frame,
                                  double at_s) {
  if (shots.empty()) return options;
  const FilmShot& shot = *shot_of(shots, frame);
  RotoscopeOptions of_frame = options_of_shot(options, shot, at_s);
  of_frame.scene_begins = shot.begin == frame;
  of_frame.maps = maps_at(shot, frame);
  return of_frame;
}

std::optional<Dissolve> dissolve_at(std::span<const FilmShot> shots, std::int64_t frame) {
  if (shots.empty()) return std::nullopt;
  const auto shot = shot_of(shots, frame);
  const std::int64_t number = frame - shot->begin + 1;
  if (shot == shots.begin() || number > shot->dissolve_frames) return std::nullopt;
  return Dissolve{&*std::prev(shot), static_cast<float>(number) / static_cast<float>(shot->dissolve_frames + 1)};
}

std::vector<std::int64_t> cuts_of(std::span<const FilmShot> shots) {
  std::vector<std::int64_t> cuts;
  for (const FilmShot& shot : shots)
    if (shot.dissolve_frames == 0) cuts.push_back(shot.begin);
  return cuts;
}

bool begins_shot(std::span<const FilmShot> shots, std::int64_t frame) {
  return std::ranges::binary_search(shots, frame, {}, &FilmShot::begin);
}

bool has_maps(std::span<const FilmShot> shots, std::int64_t frame) {
  return !shots.empty() && !maps_at(*shot_of(shots, frame), frame).empty();
}

}  // namespace wheatstone
