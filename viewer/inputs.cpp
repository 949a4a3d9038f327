#include "inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pointing.h"
#include "viewer.h"

namespace wheatstone::viewer {
namespace {

constexpr double step_s = 0.008;
constexpr float least_move = 0.005f;  ///< of a head, for which views are drawn anew, in eye separations

// An eye that rests on a point trembles, and a tracker errs, by about half a degree: 24 pixels of a desk's screen.
constexpr double dead_zone_px = 24;
constexpr float least_change_px = 0.5f;
constexpr double gaze_easing_s = 0.15;  ///< done in half a second, about as long as eyes take to converge

/// The median of what is known close to a pixel: a gaze is no pointer that hits a thin thing.
std::optional<float> disparity_around(const Viewer& viewer, double x, double y) {
  constexpr double reach_px = 5;
  constexpr std::array<std::array<double, 2>, 5> places{{{0, 0}, {-1, 0}, {1, 0}, {0, -1}, {0, 1}}};
  std::vector<float> known;
  for (const auto& place : places)
    if (const std::optional<float> disparity =
            disparity_under(viewer, x + reach_px * place[0], y + reach_px * place[1]))
      known.push_back(*disparity);
  if (known.empty()) return {};
  std::ranges::nth_element(known, known.begin() + static_cast<std::ptrdiff_t>(known.size() / 2));
  return known[known.size() / 2];
}

}  // namespace

void Inputs::track_head(std::optional<std::uint16_t> port, Session& session) {
  if (port && tracker_ && tracker_->port() == *port) return;
  std::unique_ptr<HeadTracker> tracker = port ? std::make_unique<HeadTracker>(*port) : nullptr;
  tracker_ = std::move(tracker);
  session.tracked_head = tracker_ ? std::optional(TrackedHead{tracker_->port(), true}) : std::nullopt;
}

void Inputs::go_on(Session& session, double now_s) {
  if (!tracker_) return;
  const std::optional<float> head = tracker_->newest(now_s, session.head_filter);
  if (head && std::abs(*head - session.state.head) >= least_move) session.state.head = *head;
  session.tracked_head->is_silent = tracker_->is_silent(now_s);
}

std::optional<double> Inputs::next_step_s() const { return tracker_ ? std::optional(step_s) : std::nullopt; }

void look_at(Viewer& viewer, double x, double y) {
  Session& session = viewer.session();
  if (session.fixation && std::hypot(x - session.fixation->x, y - session.fixation->y) <= dead_zone_px) return;
  const std::optional<float> disparity = disparity_around(viewer, x, y);
  if (!disparity) return;  // beside the picture
  session.fixation = Fixation{x, y};
  const float now_px = session.zero_parallax_target_px.value_or(session.state.adjustment.zero_parallax_px);
  if (std::abs(*disparity - now_px) < least_change_px) return;
  session.zero_parallax_target_px = disparity;
  session.easing_s = gaze_easing_s;
}

}  // namespace wheatstone::viewer
