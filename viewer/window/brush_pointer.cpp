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

void BrushPointer::draw_to(const QPointF& place) {
  const RetouchBrush& brush = viewer_.session().retouch;
  if (brush.tool == RetouchTool::fill_far || brush.tool == RetouchTool::fill_near) return;  // one fill a press
  constexpr double lasso_step = 4;
  const bool is_lasso = brush.tool >= RetouchTool::lasso_nearer && brush.tool <= RetouchTool::lasso_flatten;
  const double step = is_lasso ? lasso_step : std::max(brush.radius_px * viewer_.frame()->scale / 2, 1.0);
  const QPointF from = touched_at_, way = place - from;
  const double length = std::hypot(way.x(), way.y());
  for (int i = 1; i * step <= length; ++i) touch(from + way * (i * step / length), true);
}

bool BrushPointer::take(QEvent* event, double ratio) {
  switch (event->type()) {
    case QEvent::TabletPress:
    case QEvent::TabletMove: {
      // A mouse's event follows it.
      const auto* const pen = static_cast<QTabletEvent*>(event);
      pressure_ = pen->buttons() == Qt::NoButton ? 1 : std::clamp(pen->pressure(), 0.0, 1.0);
      return false;
    }
    case QEvent::TabletRelease:
      pressure_ = 1;
      return false;
    case QEvent::MouseButtonPress:
    case QEvent::MouseButtonDblClick: {
      const auto* const mouse = static_cast<QMouseEvent*>(event);
      if (is_down_) return true;
      if (!is_chosen() || mouse->button() != Qt::LeftButton || mouse->modifiers() != Qt::NoModifier) return false;
      is_down_ = true;
      touch(mouse->position() * ratio, false);
      return true;
    }
    case QEvent::MouseMove: {
      const auto* const mouse = static_cast<QMouseEvent*>(event);
      if (!is_chosen() || !mouse->buttons().testFlag(Qt::LeftButton)) is_down_ = false;
      if (!is_down_ || viewer_.frame() == nullptr) return false;
      draw_to(mouse->position() * ratio);
      return true;
    }
    case QEvent::MouseButtonRelease:
      if (!is_down_) return false;
      if (static_cast<QMouseEvent*>(event)->button() == Qt::LeftButton) is_down_ = false;
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
