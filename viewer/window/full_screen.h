#pragma once

#include <QRect>
#include <optional>

class QScreen;
class QWidget;

namespace wheatstone::viewer {

struct Session;

/// The screen that a session's picture is to fill: the one that was asked for; else, for all views of a display, the
/// one that has its lenses' size; else the window's.
QScreen* screen_to_fill(const Session& session, const QWidget& window);

/// Brings a window to a full screen and back to where it was. Knows what to do where no window manager does it.
class FullScreen {
 public:
  bool is_on() const { return before_.has_value(); }
  void enter(QWidget& window, QScreen& screen);
  void leave(QWidget& window);
  /// A screen was unplugged: a window on it comes to the primary one.
  void screen_removed(QWidget& window, const QScreen* removed);

 private:
  std::optional<QRect> before_;
};

}  // namespace wheatstone::viewer
