#pragma once

#include <QElapsedTimer>
#include <QObject>
#include <QSocketNotifier>
#include <QTimer>
#include <functional>
#include <memory>

#include "viewer/control.h"

namespace wheatstone::viewer {

/// Called once the QApplication is there, which takes the user's locale, and before any window: numbers have points in
/// the panels, as in the English of the menus, and where the C library reads and writes them.
void use_plain_numbers();

/// The signals that cli/interrupt.h watches, told in the event loop. One at a time.
class EndSignals final : public QObject {
 public:
  explicit EndSignals(std::function<void()> told);
  ~EndSignals() override;

 private:
  std::function<void()> told_;
};

/// Lets clients of a control socket speak to a viewer as the event loop goes round.
class ControlLink final : public QObject {
 public:
  /// `refresh` shows what lines have changed.
  ControlLink(std::unique_ptr<Control> control, Viewer& viewer, std::function<void()> refresh);

 private:
  void go_on();

  std::unique_ptr<Control> control_;
  Viewer& viewer_;
  std::function<void()> refresh_;
  QSocketNotifier notifier_;
  QTimer timer_;  ///< while lines wait
};

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
