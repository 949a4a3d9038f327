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

}  // namespace

std::span<const MovableParameter> movable_parameters() { return movable; }

const MovableParameter* find_movable_parameter(std::string_view name) {
  const auto* const found = std::ranges::find(movable, name, &MovableParameter::name);
  return found == movable.end() ? nullptr : found;
}

RotoscopeOptions options_of_frame(const RotoscopeOptions& options, std::span<const FilmShot> shots, std::int64_t frame,
                                  double at_s) {
  RotoscopeOptions of_frame = options;
  if (shots.empty()) return of_frame;
  static_assert(field_count<FilmShot>() == 5);
  const FilmShot& shot = *std::prev(std::ranges::upper_bound(shots, frame, {}, &FilmShot::begin));
  of_frame.style = shot.style;
  of_frame.depth_budget = shot.depth_budget;
  of_frame.zero_parallax_px = shot.zero_parallax_px;
  of_frame.scene_begins = shot.begin == frame;
  for (const MovingParameter& parameter : shot.moving) {
    find_movable_parameter(parameter.name)->set(of_frame, value_at(parameter, at_s));
    of_frame.eyes_move |= parameter.name == "depth-budget" || parameter.name == "zero-parallax";
  }
  return of_frame;
}

bool begins_shot(std::span<const FilmShot> shots, std::int64_t frame) {
  return std::ranges::binary_search(shots, frame, {}, &FilmShot::begin);
}

}  // namespace wheatstone
