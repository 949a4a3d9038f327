#pragma once

#include <QRect>
#include <optional>

class QScreen;
class QWidget;

namespace wheatstone::viewer {

struct Session;

/// The screen that viewer/screens.h chooses.
QScreen* screen_to_fill(const Session& session, const QWidget& window);

/// Brings a window to a full screen and back to where it was. Knows what to do where no window manager does it.
class FullScreen {
 public:
  bool is_on() const { return before_.has_value(); }
  void enter(QWidget& window, QScreen& screen);
  void leave(QWidget& window);
  /// A screen was unplugged: a window on it comes to the primary one. True where it filled the one that is gone, which
  /// it is to leave.
  bool screen_removed(QWidget& window, const QScreen* removed);

 private:
  std::optional<QRect> before_;
  const QScreen* filled_ = nullptr;  ///< to be compared only
};

}  // namespace wheatstone::viewer
