#pragma once

#include <cstdint>
#include <optional>

#include "head_filter.h"
#include "opentrack.h"

namespace wheatstone::viewer {

/// Receives a head's position from OpenTrack or whatever speaks like it.
class HeadTracker {
 public:
  /// Listens on a UDP port, from any machine; 0: one that is free. Throws Error{cannot_read_write} where it is taken.
  explicit HeadTracker(std::uint16_t port);
  ~HeadTracker();
  HeadTracker(const HeadTracker&) = delete;
  HeadTracker& operator=(const HeadTracker&) = delete;

  std::uint16_t port() const { return port_; }
  /// The steadied position to the right of the middle, in eye separations, from all that has arrived; none where
  /// nothing has. Does not block.
  std::optional<float> newest(double now_s, const HeadFilterOptions& options);
  /// How far from the screen the last position lies behind the one that the tracker was centred at, in cm; 0 where
  /// nothing has arrived. Not steadied.
  double farther_cm() const { return farther_cm_; }
  /// Nothing has come for a second, or ever.
  bool is_silent(double now_s) const;

 private:
  int descriptor_ = -1;
  std::uint16_t port_ = 0;
  HeadFilter filter_;
  std::optional<double> heard_at_s_;
  double farther_cm_ = 0;
};

}  // namespace wheatstone::viewer
