#include "panels.h"

#include <QDockWidget>
#include <QFormLayout>
#include <QLayout>
#include <QMainWindow>
#include <QScrollArea>
#include <utility>

#include "command_controls.h"
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

/// The commands of the menus Camera and Particles, but for what is told by a number of words.
struct ParticlesPanel {
  explicit ParticlesPanel(const DoCommand& do_command)
      : widget(new QWidget),
        form(new QFormLayout(widget)),
        camera("Camera", true, *form, do_command),
        particles("Particles", true, *form, do_command),
        depth("Depth", false, *form, do_command) {}
  QWidget* widget;
  QFormLayout* form;
  CommandControls camera, particles, depth;
};

struct Panels::Parts {
  StylePanel style;
  DepthPanel depth;
  ParticlesPanel particles;
  QDockWidget* style_dock;
  QDockWidget* depth_dock;
  QDockWidget* particles_dock;
  QMainWindow& window;
  Panel shown = Panel::off;

  Parts(QMainWindow& around, const DoCommand& do_command)
      : style(do_command),
        depth(do_command),
        particles(do_command),
        style_dock(make_dock(around, "Style", style.widget())),
        depth_dock(make_dock(around, "Depth", depth.widget())),
        particles_dock(make_dock(around, "Particles", particles.widget)),
        window(around) {}
};

Panels::Panels(QMainWindow& window, DoCommand do_command)
    : parts_(std::make_unique<Parts>(window, std::move(do_command))) {}

Panels::~Panels() = default;

void Panels::show(const Viewer& viewer) {
  const Panel panel = viewer.session().panel;
  parts_->style_dock->setVisible(panel == Panel::style);
  parts_->depth_dock->setVisible(panel == Panel::depth);
  parts_->particles_dock->setVisible(panel == Panel::particles);
  // The picture gets its new size at once, so that it is drawn in it before anybody asks whether all is drawn.
  if (std::exchange(parts_->shown, panel) != panel) parts_->window.layout()->activate();
  if (panel == Panel::style) parts_->style.show(viewer);
  if (panel == Panel::depth) parts_->depth.show(viewer);
  if (panel == Panel::particles) {
    parts_->particles.camera.show(viewer);
    parts_->particles.particles.show(viewer);
    parts_->particles.depth.show(viewer);
  }
}

}  // namespace wheatstone::viewer
