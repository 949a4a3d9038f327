#include "gaze.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <variant>
#include <vector>

#include "depth_placing.h"
#include "pointing.h"
#include "viewer.h"

namespace wheatstone::viewer {
namespace {

// An eye that rests on a point trembles, and a tracker errs, by about half a degree: 24 pixels of a desk's screen.
constexpr double dead_zone_px = 24;
constexpr float least_change_px = 0.5f;
constexpr double gaze_easing_s = 0.15;   ///< done in half a second, about as long as eyes take to converge
constexpr float reach_of_widths = 0.2f;  ///< of more depth: ten degrees on a desk's screen

/// The median of what is known close to a pixel: a gaze is no pointer that hits a thin thing.
std::optional<SeenPlace> seen_around(const Viewer& viewer, double x, double y) {
  constexpr double reach_px = 5;
  constexpr std::array<std::array<double, 2>, 5> places{{{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  std::vector<SeenPlace> known;
  for (const auto& place : places)
    if (const std::optional<SeenPlace> seen = seen_at(viewer, x + reach_px * place[0], y + reach_px * place[1]))
      known.push_back(*seen);
  if (known.empty()) return {};
  const auto middle = known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2);
  std::ranges::nth_element(known, middle, {}, &SeenPlace::disparity_px);
  return *middle;
}

void move_depth_to(Session& session, const SeenPlace& seen) {
  const GazeGains& gains = session.gaze_gains;
  std::optional<DepthAround>& now = session.state.depth_around;
  if (gains == GazeGains() || !can_bend(session.opened.content)) return;
  const float radius_px = reach_of_widths * static_cast<float>(size_of(session.opened.content).width);
  session.depth_around_target = DepthAround{seen.x, seen.y, seen.disparity_px, gains.there, gains.elsewhere, radius_px};
  if (now) return;
  // It begins there, with as much depth as everywhere.
  now = session.depth_around_target;
  now->gain_there = now->gain_elsewhere = 1;
}

}  // namespace

void look_at(Viewer& viewer, double x, double y) {
  Session& session = viewer.session();
  if (session.fixation && std::hypot(x - session.fixation->x, y - session.fixation->y) <= dead_zone_px) return;
  const std::optional<SeenPlace> seen = seen_around(viewer, x, y);
  if (!seen) return;  // beside the picture
  session.fixation = Fixation{x, y};
  move_depth_to(session, *seen);
  const float now_px = session.zero_parallax_target_px.value_or(session.state.adjustment.zero_parallax_px);
  if (std::abs(seen->disparity_px - now_px) < least_change_px) return;
  session.zero_parallax_target_px = seen->disparity_px;
  session.easing_s = gaze_easing_s;
}

void set_gaze_gains(Session& session, const GazeGains& gains) {
  session.gaze_gains = gains;
  session.fixation.reset();  // the next gaze counts, wherever it is
  if (!session.state.depth_around) return;
  if (!session.depth_around_target) session.depth_around_target = session.state.depth_around;
  session.depth_around_target->gain_there = gains.there;
  session.depth_around_target->gain_elsewhere = gains.elsewhere;
}

void move_depth_around(Session& session, double passed_s) {
  std::optional<DepthAround>& target = session.depth_around_target;
  std::optional<DepthAround>& now = session.state.depth_around;
  if (!target || !now) return;
  // What is left then moves nothing by more than half a pixel.
  constexpr float near_enough_px = 2, near_enough_disparity_px = 0.1f, near_enough_gain = 0.01f;
  const auto share = static_cast<float>(1 - std::exp(-passed_s / gaze_easing_s));
  bool is_there = true;
  const auto move = [&](float DepthAround::*number, float near_enough) {
    const float rest = *target.*number - *now.*number;
    *now.*number += share * rest;
    is_there = is_there && std::abs(rest) < near_enough;
  };
  for (float DepthAround::*place : {&DepthAround::x, &DepthAround::y}) move(place, near_enough_px);
  move(&DepthAround::disparity_px, near_enough_disparity_px);
  for (float DepthAround::*gain : {&DepthAround::gain_there, &DepthAround::gain_elsewhere})
    move(gain, near_enough_gain);
  if (!is_there) return;
  now = target;
  target.reset();
  if (now->gain_there == 1 && now->gain_elsewhere == 1) now.reset();
}

}  // namespace wheatstone::viewer
