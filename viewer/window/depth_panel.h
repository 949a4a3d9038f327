#pragma once

#include <QTimer>
#include <QWidget>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "command_controls.h"
#include "panels.h"
#include "wheatstone/depth/depth_regions.h"
#include "wheatstone/depth/viewing_geometry.h"

class QComboBox;
class QLabel;

namespace wheatstone::viewer {

/// What depths in millimetres are on a display's screen, and how far they are comfortable in front of it and behind.
struct DepthScale {
  ViewingGeometry viewing;
  float near_mm = 0, far_mm = 0;

  /// Parallax in % of the screen's width.
  float percent(float behind_mm) const;
  float behind_mm(float percent) const;
};

using RegionsChanged = std::function<void(const std::vector<DepthRegion>&)>;

/// A widget on which the points between regions are dragged.
class RegionsWidget : public QWidget {
 public:
  explicit RegionsWidget(QWidget* parent);
  void show(std::vector<DepthRegion> regions, const DepthScale& scale);
  void on_change(RegionsChanged changed) { changed_ = std::move(changed); }
  const DepthScale& scale() const { return scale_; }

 protected:
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void mouseDoubleClickEvent(QMouseEvent* event) override;

  virtual QPointF place_of(const DepthRegion& region) const = 0;
  /// What a point becomes that is dragged to a place; kept between its neighbours afterwards.
  virtual DepthRegion moved(const DepthRegion& region, const QPointF& to) const = 0;

  QRectF area() const;
  double x_of(float share) const;
  float share_of(double x) const;
  const std::vector<DepthRegion>& regions() const { return regions_; }

 private:
  std::optional<std::size_t> region_at(const QPointF& place) const;
  void change(std::vector<DepthRegion> regions);

  std::vector<DepthRegion> regions_;
  DepthScale scale_;
  RegionsChanged changed_;
  std::optional<std::size_t> dragged_;
};

/// Fig. 6.1a: the depth planes of the display laid out over the scene's depth, from near to far; regions get more of
/// them where their ends are dragged together.
class DepthPlanes final : public RegionsWidget {
 public:
  explicit DepthPlanes(QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
  QPointF place_of(const DepthRegion& region) const override;
  DepthRegion moved(const DepthRegion& region, const QPointF& to) const override;
};

/// Fig. 6.1b: the scene's depth against disparity, with what is comfortable.
class DepthGraph final : public RegionsWidget {
 public:
  explicit DepthGraph(QWidget* parent);

 protected:
  void paintEvent(QPaintEvent* event) override;
  QPointF place_of(const DepthRegion& region) const override;
  DepthRegion moved(const DepthRegion& region, const QPointF& to) const override;

 private:
  double y_of(float percent) const;
  float most_percent() const;
};

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
  std::unique_ptr<CommandControls> depth_controls_, tracking_controls_, retouch_controls_;
  QComboBox* display_;
  DepthPlanes* planes_;
  DepthGraph* graph_;
  QLabel* told_;
  std::string waiting_;
  QTimer timer_;
};

}  // namespace wheatstone::viewer
