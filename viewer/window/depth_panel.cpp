#include "depth_panel.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QMouseEvent>
#include <QPainter>
#include <QPushButton>
#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "viewer/depth_seen.h"
#include "viewer/viewer.h"
#include "wheatstone/depth/display_presets.h"

namespace wheatstone::viewer {
namespace {

constexpr double handle_px = 5, reach_px = 14;
constexpr float least_step = 0.01f;  ///< of shares between two points
const QColor comfortable_colour(60, 140, 80, 70), line_colour(70, 130, 220), grid_colour(128, 128, 128, 120);

constexpr int sent_after_ms = 20;

QLabel* make_text(const char* text, QWidget* parent) {
  auto* const label = new QLabel(text, parent);
  label->setWordWrap(true);
  return label;
}

}  // namespace

float DepthScale::percent(float behind_mm) const {
  const float nearest_mm = -0.95f * viewing.viewing_distance_mm;
  return 100 * screen_parallax_mm(viewing, std::max(behind_mm, nearest_mm)) / viewing.screen_width_mm;
}

float DepthScale::behind_mm(float percent) const {
  // The eyes must not have to look apart.
  const float widest_mm = 0.98f * viewing.eye_separation_mm;
  const float behind = perceived_depth_mm(viewing, std::min(percent / 100 * viewing.screen_width_mm, widest_mm));
  return std::round(std::max(behind, -0.95f * viewing.viewing_distance_mm) * 10) / 10;
}

RegionsWidget::RegionsWidget(QWidget* parent) : QWidget(parent) {}

void RegionsWidget::show(std::vector<DepthRegion> regions, const DepthScale& scale) {
  regions_ = std::move(regions);
  scale_ = scale;
  update();
}

QRectF RegionsWidget::area() const { return QRectF(rect()).adjusted(34, 10, -12, -18); }
double RegionsWidget::x_of(float share) const { return area().left() + static_cast<double>(share) * area().width(); }
float RegionsWidget::share_of(double x) const {
  const auto share = static_cast<float>(std::clamp((x - area().left()) / area().width(), 0., 1.));
  return std::round(share * 1000) / 1000;
}

std::optional<std::size_t> RegionsWidget::region_at(const QPointF& place) const {
  std::optional<std::size_t> nearest;
  double least = reach_px;
  for (std::size_t i = 0; i < regions_.size(); ++i) {
    const QPointF away = place_of(regions_[i]) - place;
    if (const double distance = std::hypot(away.x(), away.y()); distance < least) {
      least = distance;
      nearest = i;
    }
  }
  return nearest;
}

void RegionsWidget::change(std::vector<DepthRegion> regions) {
  regions_ = regions;
  if (changed_) changed_(regions);
  update();
}

void RegionsWidget::mousePressEvent(QMouseEvent* event) {
  dragged_ = region_at(event->position());
  if (event->button() != Qt::RightButton || !dragged_ || regions_.size() <= 2) return;
  std::vector<DepthRegion> left = regions_;
  left.erase(left.begin() + static_cast<std::ptrdiff_t>(*std::exchange(dragged_, {})));
  change(std::move(left));
}

void RegionsWidget::mouseMoveEvent(QMouseEvent* event) {
  if (!dragged_ || *dragged_ >= regions_.size()) return;
  const std::size_t i = *dragged_;
  std::vector<DepthRegion> regions = regions_;
  DepthRegion region = moved(regions[i], event->position());
  // Neither interface turns the scene inside out.
  const float first = i == 0 ? 0 : regions[i - 1].share + least_step;
  const float last = i + 1 == regions.size() ? 1 : regions[i + 1].share - least_step;
  region.share = std::clamp(region.share, std::min(first, last), std::max(first, last));
  if (i > 0) region.behind_mm = std::max(region.behind_mm, regions[i - 1].behind_mm);
  if (i + 1 < regions.size()) region.behind_mm = std::min(region.behind_mm, regions[i + 1].behind_mm);
  regions[i] = region;
  change(std::move(regions));
}

void RegionsWidget::mouseReleaseEvent(QMouseEvent* /*event*/) { dragged_.reset(); }

void RegionsWidget::mouseDoubleClickEvent(QMouseEvent* event) {
  const float share = share_of(event->position().x());
  const auto behind = std::ranges::upper_bound(regions_, share, {}, &DepthRegion::share);
  if (regions_.size() < 2 || behind == regions_.begin() || behind == regions_.end()) return;
  const DepthRegion &before = *(behind - 1), &after = *behind;
  if (share - before.share < least_step || after.share - share < least_step) return;
  // A new point changes nothing until it is dragged.
  const float part = (share - before.share) / (after.share - before.share);
  const float percent =
      scale_.percent(before.behind_mm) + part * (scale_.percent(after.behind_mm) - scale_.percent(before.behind_mm));
  std::vector<DepthRegion> more = regions_;
  more.insert(more.begin() + (behind - regions_.begin()), {share, scale_.behind_mm(percent)});
  change(std::move(more));
}

DepthPlanes::DepthPlanes(QWidget* parent) : RegionsWidget(parent) {
  setFixedHeight(58);
  setMinimumWidth(220);
  setAccessibleName("Depth planes");
}

QPointF DepthPlanes::place_of(const DepthRegion& region) const { return {x_of(region.share), area().center().y()}; }

DepthRegion DepthPlanes::moved(const DepthRegion& region, const QPointF& to) const {
  return {share_of(to.x()), region.behind_mm};
}

void DepthPlanes::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF bar = area();
  painter.setPen(grid_colour);
  painter.drawRect(bar);
  painter.setPen(palette().color(QPalette::WindowText));
  painter.drawText(QRectF(0, bar.top(), bar.left() - 6, bar.height()), Qt::AlignRight | Qt::AlignVCenter, "N");
  painter.drawText(QRectF(bar.right() + 1, bar.top(), 12, bar.height()), Qt::AlignCenter, "F");
  // Planes stand where disparity passes whole steps.
  constexpr int planes = 24;
  if (regions().size() >= 2) {
    const float first = scale().percent(regions().front().behind_mm);
    const float range = scale().percent(regions().back().behind_mm) - first;
    painter.setPen(QPen(line_colour, 1));
    for (std::size_t i = 0; i + 1 < regions().size(); ++i) {
      const float from = scale().percent(regions()[i].behind_mm), to = scale().percent(regions()[i + 1].behind_mm);
      for (int plane = 0; plane <= planes && to > from; ++plane) {
        const float at = first + range * static_cast<float>(plane) / planes;
        if (at < from || at > to) continue;
        const float part = (at - from) / (to - from);
        const double x = x_of(regions()[i].share + part * (regions()[i + 1].share - regions()[i].share));
        painter.drawLine(QPointF(x, bar.top()), QPointF(x, bar.bottom()));
      }
    }
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(palette().color(QPalette::Highlight));
  for (const DepthRegion& region : regions()) {
    const QPointF at = place_of(region);
    painter.drawRect(QRectF(at.x() - 3, bar.top() - 4, 6, bar.height() + 8));
  }
}

DepthGraph::DepthGraph(QWidget* parent) : RegionsWidget(parent) {
  setMinimumSize(220, 240);
  setAccessibleName("Graph of scene depth against disparity");
}

float DepthGraph::most_percent() const {
  float most = 1.3f * std::max(-scale().percent(-scale().near_mm), scale().percent(scale().far_mm));
  for (const DepthRegion& region : regions()) most = std::max(most, 1.1f * std::abs(scale().percent(region.behind_mm)));
  return std::max(most, 0.5f);
}

double DepthGraph::y_of(float percent) const {
  const double half = area().height() / 2;
  return area().center().y() + static_cast<double>(percent / most_percent()) * half;
}

QPointF DepthGraph::place_of(const DepthRegion& region) const {
  return {x_of(region.share), y_of(scale().percent(region.behind_mm))};
}

DepthRegion DepthGraph::moved(const DepthRegion& region, const QPointF& to) const {
  const auto shift = static_cast<float>((to.y() - area().center().y()) / (area().height() / 2));
  const float percent = std::clamp(shift, -1.f, 1.f) * most_percent();
  return {region.share == 0 || region.share == 1 ? region.share : share_of(to.x()), scale().behind_mm(percent)};
}

void DepthGraph::paintEvent(QPaintEvent* /*event*/) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QRectF box = area();
  const double top = y_of(scale().percent(-scale().near_mm)), bottom = y_of(scale().percent(scale().far_mm));
  painter.fillRect(QRectF(box.left(), top, box.width(), bottom - top).intersected(box), comfortable_colour);
  painter.setPen(grid_colour);
  painter.drawRect(box);
  painter.drawLine(QPointF(box.left(), y_of(0)), QPointF(box.right(), y_of(0)));
  painter.setPen(palette().color(QPalette::WindowText));
  const auto label = [&](double y, const QString& text) {
    painter.drawText(QRectF(0, y - 8, box.left() - 4, 16), Qt::AlignRight | Qt::AlignVCenter, text);
  };
  // Disparity is the other way round than parallax: what is before the screen has more of it.
  label(y_of(0), "0");
  label(top, QString("+%1").arg(-scale().percent(-scale().near_mm), 0, 'f', 1));
  label(bottom, QString("−%1").arg(scale().percent(scale().far_mm), 0, 'f', 1));
  painter.drawText(QRectF(box.left(), box.bottom() + 2, box.width(), 16), Qt::AlignLeft, "N");
  painter.drawText(QRectF(box.left(), box.bottom() + 2, box.width(), 16), Qt::AlignRight, "F");
  painter.drawText(QRectF(box.left(), box.bottom() + 2, box.width(), 16), Qt::AlignHCenter, "scene depth");
  if (regions().empty()) return;
  QPolygonF curve;
  curve << QPointF(box.left(), place_of(regions().front()).y());
  for (const DepthRegion& region : regions()) curve << place_of(region);
  curve << QPointF(box.right(), place_of(regions().back()).y());
  painter.setPen(QPen(line_colour, 2));
  painter.drawPolyline(curve);
  painter.setPen(Qt::NoPen);
  painter.setBrush(palette().color(QPalette::Highlight));
  for (const DepthRegion& region : regions()) painter.drawEllipse(place_of(region), handle_px, handle_px);
  painter.setPen(palette().color(QPalette::WindowText));
  for (const DepthRegion& region : regions()) {
    const QPointF at = place_of(region);
    const QRectF beside(at.x() + (region.share > 0.7f ? -76 : 8), at.y() - 18, 68, 16);
    painter.drawText(beside, region.share > 0.7f ? Qt::AlignRight : Qt::AlignLeft,
                     QString("%1 mm").arg(std::lround(region.behind_mm)));
  }
}

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
  auto* const numbers = new QFormLayout;
  column->addLayout(numbers);
  depth_controls_ = std::make_unique<CommandControls>("Depth", false, *numbers, do_command_);
  tracking_controls_ = std::make_unique<CommandControls>("Tracking", false, *numbers, do_command_);
  retouch_controls_ = std::make_unique<CommandControls>("Retouch", true, *numbers, do_command_);
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
  if (!timer_.isActive()) timer_.start(sent_after_ms);
}

void DepthPanel::show(const Viewer& viewer) {
  const ViewState& state = viewer.session().state;
  display_->setCurrentText(QString::fromStdString(state.display));
  told_->setText(QString::fromStdString(comfort_told(viewer)));
  depth_controls_->show(viewer);
  tracking_controls_->show(viewer);
  retouch_controls_->show(viewer);
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
