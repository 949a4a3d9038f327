#include "depth_panel.h"

#include <QComboBox>
#include <QHBoxLayout>
#include <QLabel>
#include <QPushButton>
#include <QVBoxLayout>
#include <utility>

#include "viewer/comfort.h"
#include "viewer/viewer.h"
#include "wheatstone/depth/display_presets.h"

namespace wheatstone::viewer {
namespace {

constexpr int settles_after_ms = 20;

QLabel* make_text(const char* text, QWidget* parent) {
  auto* const label = new QLabel(text, parent);
  label->setWordWrap(true);
  return label;
}

}  // namespace

DepthPanel::DepthPanel(DoCommand do_command)
    : do_command_(std::move(do_command)),
      widget_(new QWidget),
      display_(new QComboBox(widget_)),
      planes_(new DepthPlanes(widget_)),
      graph_(new DepthGraph(widget_)),
      told_(make_text("", widget_)) {
  auto* const column = new QVBoxLayout(widget_);
  for (const DisplayPreset& display : display_presets()) display_->addItem(QString::fromUtf8(display.name));
  display_->setAccessibleName("Display");
  QObject::connect(display_, &QComboBox::activated, widget_,
                   [this] { do_command_("display", {display_->currentText().toStdString()}); });
  column->addWidget(display_);
  column->addWidget(make_text("Depth planes, from the nearest part of the scene (N) to the farthest (F)", widget_));
  column->addWidget(planes_);
  column->addWidget(
      make_text("Disparity on the screen, in % of its width, against the scene's depth. Drag the points. "
                "Double-click to add one. Right-click to remove one.",
                widget_));
  column->addWidget(graph_, 1);
  auto* const buttons = new QHBoxLayout;
  for (const auto& [text, mapping] : {std::pair{"Comfortable", "comfortable"}, std::pair{"As photographed", "reset"}}) {
    auto* const button = new QPushButton(text, widget_);
    const std::string word = mapping;
    QObject::connect(button, &QPushButton::clicked, widget_, [this, word] { do_command_("depth-mapping", {word}); });
    buttons->addWidget(button);
  }
  column->addLayout(buttons);
  column->addWidget(told_);
  const auto changed = [this](const std::vector<DepthRegion>& regions) { set_soon(regions); };
  planes_->on_change(changed);
  graph_->on_change(changed);
  timer_.setSingleShot(true);
  QObject::connect(&timer_, &QTimer::timeout, widget_,
                   [this] { do_command_("depth-mapping", {std::exchange(waiting_, {})}); });
}

void DepthPanel::set_soon(const std::vector<DepthRegion>& regions) {
  waiting_ = wheatstone::text_of(regions);
  planes_->show(regions, graph_->scale());
  graph_->show(regions, graph_->scale());
  if (!timer_.isActive()) timer_.start(settles_after_ms);
}

void DepthPanel::show(const Viewer& viewer) {
  const ViewState& state = viewer.session().state;
  display_->setCurrentText(QString::fromStdString(state.display));
  told_->setText(QString::fromStdString(comfort_told(viewer)));
  if (timer_.isActive()) return;
  const ViewingGeometry viewing = viewing_of(find_display(state.display));
  std::vector<DepthRegion> regions = state.depth_regions;
  const std::optional<DepthSeen> seen = depth_seen(viewer);
  if (regions.empty() && seen) regions = {{0, -seen->near_mm}, {1, seen->far_mm}};
  const ComfortableDepth comfortable = comfortable_depth(viewing);
  const DepthScale scale{viewing, comfortable.near_mm, comfortable.far_mm};
  planes_->show(regions, scale);
  graph_->show(regions, scale);
}

}  // namespace wheatstone::viewer
