#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "head_tracker.h"
#include "session.h"

namespace wheatstone::viewer {

/// What moves a session's view besides commands and time.
class Inputs {
 public:
  /// Follows a head from now on, or no longer. Throws as HeadTracker does; the head is then followed as before.
  void track_head(std::optional<std::uint16_t> port, Session& session);
  /// Takes over what has arrived.
  void go_on(Session& session, double now_s);
  /// Seconds after which go_on is to be called; none where nothing is followed.
  std::optional<double> next_step_s() const;

 private:
  std::unique_ptr<HeadTracker> tracker_;
};

}  // namespace wheatstone::viewer
