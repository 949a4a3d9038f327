#pragma once

#include <QPointF>

#include "panels.h"

class QEvent;
class QWidget;

namespace wheatstone::viewer {

/// The pointer, or a pen, as the brush that retouches depth and detail.
class BrushPointer {
 public:
  BrushPointer(const Viewer& viewer, DoCommand do_command);

  /// Takes what the pointer does on the picture; false where that is not the brush's. `ratio` is of the frame's pixels
  /// to the event's.
  bool take(QEvent* event, double ratio);
  /// Shows how large the brush is where the pointer is.
  void show(QWidget& picture, double ratio);

 private:
  bool is_chosen() const;
  void touch(const QPointF& place, bool goes_on);
  /// Touches on the way to a place, half a radius apart.
  void draw_to(const QPointF& place);

  const Viewer& viewer_;
  DoCommand do_command_;
  QPointF touched_at_;
  bool is_down_ = false;
  double pressure_ = 1;  ///< of a pen
  int shown_px_ = 0;     ///< diameter of the cursor; 0: none
};

}  // namespace wheatstone::viewer
