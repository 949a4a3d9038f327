#include "brush_pointer.h"

#include <fmt/format.h>

#include <QCursor>
#include <QMouseEvent>
#include <QPainter>
#include <QPixmap>
#include <QTabletEvent>
#include <QWidget>
#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/viewer.h"

namespace wheatstone::viewer {
namespace {

QCursor circle(int diameter_px) {
  QPixmap picture(diameter_px + 3, diameter_px + 3);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  for (const auto& [colour, width] : {std::pair{Qt::black, 3.0}, std::pair{Qt::white, 1.0}}) {
    painter.setPen(QPen(colour, width));
    painter.drawEllipse(QRectF(1.5, 1.5, diameter_px, diameter_px));
  }
  painter.end();
  return QCursor(picture);
}

}  // namespace

BrushPointer::BrushPointer(const Viewer& viewer, DoCommand do_command)
    : viewer_(viewer), do_command_(std::move(do_command)) {}

bool BrushPointer::is_chosen() const {
  return viewer_.session().retouch.tool != RetouchTool::off && applies(viewer_, find_command("touch"));
}

void BrushPointer::touch(const QPointF& place, bool goes_on) {
  touched_at_ = place;
  do_command_(goes_on ? "touch-on" : "touch",
              {fmt::format("{}", place.x()), fmt::format("{}", place.y()), fmt::format("{:.3f}", pressure_)});
}

bool BrushPointer::take(QEvent* event, double ratio) {
  switch (event->type()) {
    case QEvent::TabletPress:
    case QEvent::TabletMove:
      // A mouse's event follows it.
      pressure_ = std::clamp(static_cast<QTabletEvent*>(event)->pressure(), 0.0, 1.0);
      return false;
    case QEvent::TabletRelease:
      pressure_ = 1;
      return false;
    case QEvent::MouseButtonPress: {
      const auto* const mouse = static_cast<QMouseEvent*>(event);
      if (!is_chosen() || mouse->button() != Qt::LeftButton || mouse->modifiers() != Qt::NoModifier) return false;
      is_down_ = true;
      touch(mouse->position() * ratio, false);
      return true;
    }
    case QEvent::MouseMove: {
      if (!is_down_ || viewer_.frame() == nullptr) return false;
      const QPointF place = static_cast<QMouseEvent*>(event)->position() * ratio;
      const double step = viewer_.session().retouch.radius_px * viewer_.frame()->scale / 2;
      if (std::hypot(place.x() - touched_at_.x(), place.y() - touched_at_.y()) >= step) touch(place, true);
      return true;
    }
    case QEvent::MouseButtonRelease:
      return std::exchange(is_down_, false);
    case QEvent::MouseButtonDblClick:
      if (!is_chosen()) return false;
      is_down_ = true;
      touch(static_cast<QMouseEvent*>(event)->position() * ratio, false);
      return true;
    default:
      return false;
  }
}

void BrushPointer::show(QWidget& picture, double ratio) {
  constexpr int least_px = 4, most_px = 512;
  int diameter_px = 0;
  if (is_chosen() && viewer_.frame() != nullptr)
    diameter_px = std::clamp(static_cast<int>(2 * viewer_.session().retouch.radius_px * viewer_.frame()->scale / ratio),
                             least_px, most_px);
  if (diameter_px == shown_px_) return;
  shown_px_ = diameter_px;
  if (diameter_px == 0)
    picture.unsetCursor();
  else
    picture.setCursor(circle(diameter_px));
}

}  // namespace wheatstone::viewer
