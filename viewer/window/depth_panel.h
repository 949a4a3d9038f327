#pragma once

#include <QTimer>
#include <QWidget>
#include <string>

#include "depth_graph.h"
#include "panels.h"

class QComboBox;
class QLabel;

namespace wheatstone::viewer {

/// Both interfaces of Hassaine 2010, fig. 6.1, for where the scene's parts seem to be, and the display that it is for.
class DepthPanel {
 public:
  explicit DepthPanel(DoCommand do_command);
  QWidget* widget() { return widget_; }
  void show(const Viewer& viewer);

 private:
  void set_soon(const std::vector<DepthRegion>& regions);

  DoCommand do_command_;
  QWidget* widget_;
  QComboBox* display_;
  DepthPlanes* planes_;
  DepthGraph* graph_;
  QLabel* told_;
  std::string waiting_;
  QTimer timer_;
};

}  // namespace wheatstone::viewer
