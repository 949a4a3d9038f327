#pragma once

#include <QObject>
#include <QSocketNotifier>
#include <QTimer>
#include <functional>
#include <memory>

#include "viewer/control.h"

namespace wheatstone::viewer {

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

}  // namespace wheatstone::viewer
