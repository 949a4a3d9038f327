#pragma once

#include <QElapsedTimer>
#include <QTimer>

namespace wheatstone::viewer {

/// Measures for how long the event loop was blocked: how much later than asked for a timer is served.
class Heartbeat {
 public:
  /// Begins to measure.
  void start();
  /// Leaves out what was blocked since the last beat: it was asked for.
  void forgive();
  /// The longest since this was last asked.
  double take_worst_gap_ms();

 private:
  QTimer timer_;
  QElapsedTimer since_beat_;
  double worst_gap_ms_ = 0;
};

}  // namespace wheatstone::viewer
