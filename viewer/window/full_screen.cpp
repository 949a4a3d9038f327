#include "full_screen.h"

#include <QGuiApplication>
#include <QScreen>
#include <QWidget>
#include <QWindow>
#include <string>
#include <utility>
#include <vector>

#include "viewer/screens.h"

namespace wheatstone::viewer {
namespace {

DesktopArea area_of(const QRect& place) { return {place.x(), place.y(), place.width(), place.height()}; }

}  // namespace

QScreen* screen_to_fill(const Session& session, const QWidget& window) {
  const QList<QScreen*> found = QGuiApplication::screens();
  std::vector<Screen> screens;
  for (const QScreen* const screen : found) {
    const QSize size = screen->size() * screen->devicePixelRatio();
    const QString name = screen->name() + ' ' + screen->manufacturer() + ' ' + screen->model();
    screens.push_back({name.toStdString(), size.width(), size.height()});
  }
  const int number = screen_to_fill(session, screens);
  return number == 0 ? window.screen() : found[number - 1];
}

void FullScreen::enter(QWidget& window, QScreen& screen) {
  if (!is_on()) before_ = window.geometry();
  filled_ = &screen;
  if (QWindow* const handle = window.windowHandle()) handle->setScreen(&screen);
  window.setGeometry(screen.geometry());
  window.showFullScreen();
}

void FullScreen::leave(QWidget& window) {
  if (!is_on()) return;
  window.showNormal();
  window.setGeometry(*std::exchange(before_, std::nullopt));
}

bool FullScreen::screen_removed(QWidget& window, const QScreen* removed) {
  QScreen* const primary = QGuiApplication::primaryScreen();
  QWindow* const handle = window.windowHandle();
  if (primary == nullptr || primary == removed || handle == nullptr) return false;
  std::vector<DesktopArea> left;
  for (const QScreen* const screen : QGuiApplication::screens())
    if (screen != removed) left.push_back(area_of(screen->geometry()));
  // The window system may have moved the window already, but not to where it was made for.
  const bool was_there = handle->screen() == removed || handle->screen() == nullptr ||
                         is_lost(area_of(window.geometry()), left) || (is_on() && filled_ == removed);
  if (!was_there) return false;
  const DesktopArea place =
      brought_to(area_of(primary->availableGeometry()), area_of(is_on() ? *before_ : window.geometry()));
  const QRect here(place.left, place.top, place.width, place.height);
  handle->setScreen(primary);
  if (is_on())
    before_ = here;
  else
    window.setGeometry(here);
  return is_on();
}

}  // namespace wheatstone::viewer
