#pragma once

#include <QElapsedTimer>
#include <QTimer>

namespace wheatstone::viewer {

/// How long a thread did nothing but one thing, in milliseconds.
struct Blocked {
  double gap_ms = 0;   ///< by the clock; also counts what other threads and programs did meanwhile
  double busy_ms = 0;  ///< that the thread itself worked
};

/// Measures for how long the event loop was blocked: how much later than asked for a timer is served, and what its
/// thread did between two beats.
class Heartbeat {
 public:
  /// Begins to measure.
  void start();
  /// Leaves out what was blocked since the last beat: it was asked for.
  void forgive();
  /// The longest since this was last asked.
  Blocked take_worst();

 private:
  QTimer timer_;
  QElapsedTimer since_beat_;
  double busy_before_ms_ = 0;
  Blocked worst_;
};

}  // namespace wheatstone::viewer
