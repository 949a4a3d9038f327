#include "full_screen.h"

#include <QGuiApplication>
#include <QScreen>
#include <QWidget>
#include <QWindow>
#include <utility>

#include "viewer/session.h"
#include "viewer/stage.h"

namespace wheatstone::viewer {

QScreen* screen_to_fill(const Session& session, const QWidget& window) {
  const QList<QScreen*> screens = QGuiApplication::screens();
  if (session.screen > 0 && session.screen <= screens.size()) return screens[session.screen - 1];
  if (const std::optional<PictureSize> wanted = screen_size_of(session.state))
    for (QScreen* const screen : screens)
      if (screen->size() * screen->devicePixelRatio() == QSize(wanted->width, wanted->height)) return screen;
  return window.screen();
}

void FullScreen::enter(QWidget& window, QScreen& screen) {
  if (!is_on()) before_ = window.geometry();
  if (QWindow* const handle = window.windowHandle()) handle->setScreen(&screen);
  window.setGeometry(screen.geometry());
  window.showFullScreen();
}

void FullScreen::leave(QWidget& window) {
  if (!is_on()) return;
  window.showNormal();
  window.setGeometry(*std::exchange(before_, std::nullopt));
}

void FullScreen::screen_removed(QWidget& window, const QScreen* removed) {
  QScreen* const primary = QGuiApplication::primaryScreen();
  QWindow* const handle = window.windowHandle();
  if (primary == nullptr || primary == removed || handle == nullptr) return;
  const bool was_there = handle->screen() == removed || handle->screen() == nullptr ||
                         !primary->virtualGeometry().intersects(window.geometry());
  if (!was_there) return;
  QRect place = is_on() ? *before_ : window.geometry();
  place.setSize(place.size().boundedTo(primary->availableSize()));
  place.moveCenter(primary->availableGeometry().center());
  if (is_on()) {
    enter(window, *primary);
    before_ = place;
  } else {
    handle->setScreen(primary);
    window.setGeometry(place);
  }
}

}  // namespace wheatstone::viewer
