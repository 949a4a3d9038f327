#include "icons.h"

#include <QPainter>
#include <QPainterPath>
#include <QPalette>
#include <QPixmap>
#include <array>

namespace wheatstone::viewer {
namespace {

/// Lines in a square of 24 by 24.
QPainterPath outline_of(std::string_view name) {
  QPainterPath path;
  const auto line = [&path](std::initializer_list<QPointF> points) {
    path.moveTo(*points.begin());
    for (const QPointF& point : points) path.lineTo(point);
  };
  if (name == "open") {
    line({{3, 19}, {3, 5}, {9, 5}, {11, 8}, {20, 8}, {20, 11}});
    line({{3, 19}, {6.5, 11}, {22, 11}, {18.5, 19}, {3, 19}});
  } else if (name == "save") {
    line({{12, 3}, {12, 15}});
    line({{7, 10}, {12, 15}, {17, 10}});
    line({{4, 15}, {4, 20}, {20, 20}, {20, 15}});
  } else if (name == "style") {  // a brush
    line({{20, 4}, {11, 13}});
    path.moveTo(11, 13);
    path.cubicTo(8, 12, 6, 14, 6, 16);
    path.cubicTo(6, 18, 5, 19, 3.5, 19.5);
    path.cubicTo(7, 21, 11, 20, 12, 17);
    path.cubicTo(12.5, 15, 12, 14, 11, 13);
  } else if (name == "depth") {  // planes one behind the other
    line({{3, 9}, {12, 4}, {21, 9}, {12, 14}, {3, 9}});
    line({{3, 13}, {12, 18}, {21, 13}});
    line({{3, 17}, {12, 22}, {21, 17}});
  } else if (name == "slice") {  // a plane across a picture
    path.addRect(4, 6, 16, 13);
    line({{9, 2}, {9, 15}, {15, 22}, {15, 9}, {9, 2}});
  } else if (name == "retouch") {  // a pen, and what it has drawn
    line({{20, 4}, {8, 16}, {7, 19}, {10, 18}, {22, 6}, {20, 4}});
    path.moveTo(3, 21);
    path.quadTo(9, 18, 12, 21);
    path.quadTo(15, 23, 20, 20);
  } else if (name == "compare") {
    path.addRect(3, 5, 18, 14);
    line({{12, 2}, {12, 22}});
    line({{5, 16}, {10, 11}});
  } else if (name == "full-screen") {
    line({{3, 9}, {3, 4}, {8, 4}});
    line({{16, 4}, {21, 4}, {21, 9}});
    line({{21, 15}, {21, 20}, {16, 20}});
    line({{8, 20}, {3, 20}, {3, 15}});
  } else if (name == "mode") {  // glasses
    path.addRoundedRect(2.5, 9, 8, 7, 2.5, 2.5);
    path.addRoundedRect(13.5, 9, 8, 7, 2.5, 2.5);
    path.moveTo(10.5, 12);
    path.quadTo(12, 10.5, 13.5, 12);
  }
  return path;
}

QPixmap drawn(const QPainterPath& path, const QColor& colour, double ratio) {
  constexpr int side = 24;
  QPixmap picture(static_cast<int>(side * ratio), static_cast<int>(side * ratio));
  picture.setDevicePixelRatio(ratio);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(QPen(colour, 1.6, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawPath(path);
  return picture;
}

}  // namespace

std::span<const std::string_view> tool_icons() {
  static constexpr std::array<std::string_view, 9> names{"open",    "save",    "style",       "depth", "slice",
                                                         "retouch", "compare", "full-screen", "mode"};
  return names;
}

QIcon tool_icon(std::string_view name, const QPalette& palette) {
  QIcon icon;
  const QPainterPath path = outline_of(name);
  for (const double ratio : {1., 2.}) {
    icon.addPixmap(drawn(path, palette.color(QPalette::Active, QPalette::WindowText), ratio), QIcon::Normal);
    icon.addPixmap(drawn(path, palette.color(QPalette::Disabled, QPalette::WindowText), ratio), QIcon::Disabled);
  }
  return icon;
}

}  // namespace wheatstone::viewer
