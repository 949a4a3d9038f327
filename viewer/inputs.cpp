#include "inputs.h"

#include <cmath>

namespace wheatstone::viewer {
namespace {

constexpr double step_s = 0.008;
constexpr float least_move = 0.005f;  ///< of a head, for which views are drawn anew, in eye separations

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

}  // namespace wheatstone::viewer
