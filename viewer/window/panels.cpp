#include "panels.h"

#include <QDockWidget>
#include <QLayout>
#include <QMainWindow>
#include <QScrollArea>
#include <utility>

#include "depth_panel.h"
#include "style_panel.h"
#include "viewer/viewer.h"

namespace wheatstone::viewer {
namespace {

QDockWidget* make_dock(QMainWindow& window, const char* title, QWidget* content) {
  auto* const dock = new QDockWidget(title, &window);
  auto* const scroll = new QScrollArea(dock);
  scroll->setWidgetResizable(true);
  scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  scroll->setFrameShape(QFrame::NoFrame);
  scroll->setWidget(content);
  scroll->setMinimumWidth(content->minimumSizeHint().width() + 24);
  dock->setWidget(scroll);
  // A command shows it and takes it away.
  dock->setFeatures(QDockWidget::DockWidgetMovable | QDockWidget::DockWidgetFloatable);
  dock->hide();
  window.addDockWidget(Qt::RightDockWidgetArea, dock);
  return dock;
}

}  // namespace

struct Panels::Parts {
  StylePanel style;
  DepthPanel depth;
  QDockWidget* style_dock;
  QDockWidget* depth_dock;
  QMainWindow& window;
  Panel shown = Panel::off;

  Parts(QMainWindow& around, const DoCommand& do_command)
      : style(do_command),
        depth(do_command),
        style_dock(make_dock(around, "Style", style.widget())),
        depth_dock(make_dock(around, "Depth", depth.widget())),
        window(around) {}
};

Panels::Panels(QMainWindow& window, DoCommand do_command)
    : parts_(std::make_unique<Parts>(window, std::move(do_command))) {}

Panels::~Panels() = default;

void Panels::show(const Viewer& viewer) {
  const Panel panel = viewer.session().panel;
  parts_->style_dock->setVisible(panel == Panel::style);
  parts_->depth_dock->setVisible(panel == Panel::depth);
  // The picture gets its new size at once, so that it is drawn in it before anybody asks whether all is drawn.
  if (std::exchange(parts_->shown, panel) != panel) parts_->window.layout()->activate();
  if (panel == Panel::style) parts_->style.show(viewer);
  if (panel == Panel::depth) parts_->depth.show(viewer);
}

}  // namespace wheatstone::viewer
