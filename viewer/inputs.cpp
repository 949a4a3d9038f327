#include "inputs.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <variant>
#include <vector>

#include "depth_seen.h"
#include "orbit.h"
#include "particle_scene.h"
#include "viewer.h"
#include "wheatstone/depth/warp_row.h"

namespace wheatstone::viewer {
namespace {

constexpr double step_s = 0.008;
constexpr float least_move = 0.005f;  ///< of a head, for which views are drawn anew, in eye separations

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

/// What is left then cannot be seen.
constexpr float near_enough_gain = 0.01f;

/// Particles and slices get more depth in an area of the views. Elsewhere it stays.
void move_focus_to(Viewer& viewer, double x, double y) {
  Session& session = viewer.session();
  const std::optional<PlaceInView> place = place_at(viewer.frame()->places, x, y);
  if (!place || session.gaze_gains == GazeGains()) return;
  const PictureSize size = size_of_view(viewer);
  ScreenFocus& now = session.state.look.focus;
  ScreenFocus target = now;
  target.at = {static_cast<float>(std::clamp(place->x / size.width, 0., 1.)),
               static_cast<float>(std::clamp(place->y / size.height, 0., 1.))};
  target.gain = session.gaze_gains.there;
  check_focus_in(viewer, target);
  session.fixation = Fixation{x, y};
  session.focus_target = target;
  if (now.at) return;
  now.at = target.at;
  now.gain = 1;
}

void move_focus(Session& session, float share) {
  constexpr float near_enough_place = 0.002f;
  ScreenFocus& now = session.state.look.focus;
  const ScreenFocus target = *session.focus_target;
  if (!now.at) return session.focus_target.reset();  // somebody ended it
  float rest = std::abs(target.gain - now.gain) * near_enough_place / near_enough_gain;
  now.gain += share * (target.gain - now.gain);
  for (const std::size_t axis : {0, 1}) {
    float& place = (*now.at)[axis];
    rest = std::max(rest, std::abs((*target.at)[axis] - place));
    place += share * ((*target.at)[axis] - place);
  }
  if (rest >= near_enough_place) return;
  now = target;
  session.focus_target.reset();
  if (now.gain == 1) now = {.at = {}, .radius = now.radius};
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

constexpr float unknown_disparity = std::numeric_limits<float>::quiet_NaN();

/// The nearest surfaces of one row, as a view sees them: those of photographs first.
std::vector<float> seen_row(const Surfaces& surfaces, ViewPosition view, int y, int width) {
  std::vector<float> nearest(width, unknown_disparity);
  std::vector<float> continued(width, unknown_disparity);
  for (const Surface& surface : surfaces.seen)
    if (y < surface.disparity.height())
      for (const KnownRuns::Run& run : surface.disparity.runs_of(y))
        warp_disparity_row_over(surface.disparity.values_of(run), view - surface.view, surface.left_px + run.begin,
                                surface.continued ? continued : nearest);
  close_cracks(nearest);
  for (int x = 0; x < width; ++x)
    if (std::isnan(nearest[x])) nearest[x] = continued[x];
  return nearest;
}

std::vector<float> seen_row(const StereoGeometry& geometry, ViewPosition view, int y) {
  std::vector<float> nearest(geometry.left_disparity.width(), unknown_disparity);
  warp_disparity_row_over(geometry.left_disparity.row(y), view - left_eye, 0, nearest);
  warp_disparity_row_over(geometry.right_disparity.row(y), view - right_eye, 0, nearest);
  return nearest;
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
  if (has_focus(session.opened.content)) return move_focus_to(viewer, x, y);
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
  if (session.focus_target) session.focus_target->gain = gains.there;
  if (gains == GazeGains() && session.state.look.focus.at && has_focus(session.opened.content)) {
    session.focus_target = session.state.look.focus;
    session.focus_target->gain = 1;
  }
  if (!session.state.depth_around) return;
  if (!session.depth_around_target) session.depth_around_target = session.state.depth_around;
  session.depth_around_target->gain_there = gains.there;
  session.depth_around_target->gain_elsewhere = gains.elsewhere;
}

bool gaze_depth_moves(const Session& session) { return session.depth_around_target || session.focus_target; }

void move_gaze_depth(Session& session, double passed_s) {
  const auto share = static_cast<float>(1 - std::exp(-passed_s / gaze_easing_s));
  if (session.focus_target) move_focus(session, share);
  std::optional<DepthAround>& target = session.depth_around_target;
  std::optional<DepthAround>& now = session.state.depth_around;
  if (!target || !now) return;
  // What is left then moves nothing by more than half a pixel.
  constexpr float near_enough_px = 2, near_enough_disparity_px = 0.1f;
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

std::optional<float> disparity_at(const Content& content, const PlaceInView& place) {
  const PictureSize size = size_of(content);
  const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
  const auto* const painted = std::get_if<PaintedContent>(&content);
  if (painted == nullptr || x < 0 || y < 0 || x >= size.width || y >= size.height) return {};
  float disparity = unknown_disparity;
  if (painted->painting && !painted->painting->surfaces.seen.empty())
    disparity = seen_row(painted->painting->surfaces, place.view, y, size.width)[x];
  else if (painted->photograph && painted->photograph->geometry)
    disparity = seen_row(*painted->photograph->geometry, place.view, y)[x];
  if (std::isnan(disparity)) return {};
  return disparity;
}

std::optional<SeenPlace> seen_at(const Viewer& viewer, double x, double y) {
  const std::optional<float> disparity = disparity_under(viewer, x, y);
  if (!disparity) return {};
  const Frame& frame = *viewer.frame();
  PlaceInView place = *place_at(frame.places, x, y);
  const auto* const painted = std::get_if<PaintedContent>(&frame.shown);
  if (painted == nullptr || !painted->painting || painted->painting->surfaces.seen.empty())
    return SeenPlace{static_cast<float>(place.x), static_cast<float>(place.y), *disparity};
  const ViewPosition reference = painted->painting->surfaces.seen.front().view;
  place.x += (place.view - reference) * *disparity;
  place.view = reference;
  return SeenPlace{static_cast<float>(place.x), static_cast<float>(place.y),
                   disparity_at(frame.placed, place).value_or(*disparity)};
}

std::optional<SeenPlace> seen_in_left(const Viewer& viewer, double x, double y) {
  const std::optional<float> shown_px = disparity_under(viewer, x, y);
  if (!shown_px) return {};
  const auto* const painted = std::get_if<PaintedContent>(&viewer.session().opened.content);
  if (painted == nullptr || !painted->photograph || !painted->photograph->geometry) return {};
  // Depth that was placed for a display moves places about the reference view, not about the left one; the difference
  // is less than a brush.
  const PlaceInView place = *place_at(viewer.frame()->places, x, y);
  const double in_left = place.x + (place.view - left_eye) * *shown_px;
  const Image<float>& disparity = painted->photograph->geometry->left_disparity;
  const int column = static_cast<int>(std::floor(in_left)), row = static_cast<int>(std::floor(place.y));
  if (!disparity.contains(column, row)) return {};
  return SeenPlace{static_cast<float>(in_left), static_cast<float>(place.y), disparity(column, row)};
}

std::optional<float> disparity_under(const Viewer& viewer, double x, double y) {
  const Frame* const frame = viewer.frame();
  const std::optional<PlaceInView> place = frame != nullptr ? place_at(frame->places, x, y) : std::nullopt;
  if (!place) return {};
  if (!turns_around(viewer)) return disparity_at(frame->shown, *place);
  const std::optional<SeenPoint> seen = point_at(viewer, *place);
  return seen ? std::optional(-seen->parallax_px) : std::nullopt;
}

}  // namespace wheatstone::viewer
