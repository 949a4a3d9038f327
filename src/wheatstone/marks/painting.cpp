#include "wheatstone/marks/painting.h"

#include <tbb/parallel_for_each.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "wheatstone/marks/visit_points_internal.h"

namespace wheatstone {
namespace {

int times(int length_px, double factor) { return static_cast<int>(std::round(length_px * factor)); }

/// Moves marks and surfaces to where they are drawn. A point stands in a reference view, where less disparity is a
/// shift, too.
class Mover {
 public:
  explicit Mover(const Placement& to) : to_(to), scale_(static_cast<float>(to.scale)) {}

  template <class Marks>
  void move(Marks& marks) const {
    visit_points(marks, [this](ControlPoint& point, ViewPosition reference_view) {
      point = {static_cast<float>((static_cast<double>(point.x) + shift_in(reference_view) - to_.left) * to_.scale),
               static_cast<float>((static_cast<double>(point.y) - to_.top) * to_.scale), disparity(point.disparity)};
    });
    visit_own_disparities(marks, [this](float& own, const auto& /*first_point*/) { own = disparity(own); });
    if constexpr (std::is_same_v<Marks, StrokePainting>) scale_brushes(marks);
    marks.width = to_.width;
    marks.height = to_.height;
  }

  /// Between two surfaces there is no third one: disparities are not interpolated.
  Surface moved(const Surface& surface) const {
    const KnownRuns& from = surface.disparity;
    const double first = (surface.left_px + shift_in(surface.view) - to_.left) * to_.scale;
    Surface to{surface.view, KnownRuns(std::max(times(from.width(), to_.scale), 1), to_.height),
               static_cast<int>(std::floor(first)), surface.continued};
    // The columns of the surface that is there, from which those of the larger or smaller one come.
    std::vector<int> columns;
    const int width = to.disparity.width();
    int begin = 0;
    for (int x = 0; x < width; ++x) {
      const int column = static_cast<int>(std::floor((x + 0.5 + to.left_px - first) / to_.scale));
      if (column < 0) begin = x + 1;
      if (column >= 0 && column < from.width()) columns.push_back(column);
    }
    constexpr float unknown = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> row_from(static_cast<std::size_t>(from.width())), values(static_cast<std::size_t>(width));
    for (int y = 0; y < to_.height; ++y) {
      const int row = static_cast<int>(std::floor((y + 0.5) / to_.scale + to_.top));
      std::ranges::fill(values, unknown);
      if (row >= 0 && row < from.height()) {
        from.copy_row(row, row_from);
        for (std::size_t i = 0; i < columns.size(); ++i)
          values[static_cast<std::size_t>(begin) + i] = disparity(row_from[static_cast<std::size_t>(columns[i])]);
      }
      to.disparity.add_row(values);
    }
    return to;
  }

 private:
  float disparity(float d) const { return scale_ * (d - to_.zero_parallax_px); }
  double shift_in(ViewPosition view) const {
    return static_cast<double>(view - central_view) * static_cast<double>(to_.zero_parallax_px);
  }

  void scale_brushes(StrokePainting& painting) const {
    painting.brush.bristle_px *= scale_;
    for (Layer& layer : painting.layers) {
      layer.radius_px *= scale_;
      for (Stroke& stroke : layer.strokes) stroke.radius_px *= scale_;
    }
  }

  Placement to_;
  float scale_;
};

}  // namespace

int width_of(const Painting& painting) {
  return std::visit([](const auto& marks) { return marks.width; }, painting.marks);
}

int height_of(const Painting& painting) {
  return std::visit([](const auto& marks) { return marks.height; }, painting.marks);
}

std::span<const Layer> layers_of(const Painting& painting) {
  const auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  return strokes != nullptr ? std::span<const Layer>(strokes->layers) : std::span<const Layer>();
}

MarkCount count_marks(const Painting& painting) {
  return std::visit(
      [](const auto& marks) {
        MarkCount counted{marks.marks_name};
        if constexpr (requires { marks.layers; })
          for (const Layer& layer : marks.layers) counted.count += count_strokes(layer);
        else
          visit_marks(marks, [&](const auto& /*mark*/, const auto& /*holder*/) { ++counted.count; });
        return counted;
      },
      painting.marks);
}

Painting placed(Painting painting, const Placement& placement) {
  Placement to = placement;
  if (to.width == 0) to.width = times(width_of(painting), to.scale);
  if (to.height == 0) to.height = times(height_of(painting), to.scale);
  const Mover mover(to);
  std::visit([&](auto& marks) { mover.move(marks); }, painting.marks);
  tbb::parallel_for_each(painting.surfaces.seen, [&](Surface& surface) { surface = mover.moved(surface); });
  const auto scale = static_cast<float>(to.scale);
  painting.surfaces.tolerance_px *= scale;
  painting.relief.depth_px *= scale;
  painting.relief.bristle_px *= scale;
  return painting;
}

void shift_marks(ViewPosition reference_view, float by_px, Painting& painting) {
  const auto shift = [=](ControlPoint& point, ViewPosition view) {
    if (view == reference_view) point.x += by_px;
  };
  std::visit([&](auto& marks) { visit_points(marks, shift); }, painting.marks);
}

std::vector<float> disparities_of_marks(const Painting& painting) {
  std::vector<float> disparities;
  const auto add = [&](const auto& marks) {
    // Marks for some views only mend what these show of others, unless all of them are: one painting an eye.
    bool any_for_all = false;
    visit_marks(
        marks, [&](const auto& mark, const auto& /*holder*/) { any_for_all = any_for_all || mark.views == all_views; });
    visit_marks(marks, [&](const auto& mark, const auto& holder) {
      if (any_for_all && mark.views != all_views) return;
      if constexpr (requires { mark.disparity; })
        disparities.push_back(mark.disparity);
      else
        for (const ColourPoint& point : holder.points_of(mark)) disparities.push_back(point.at.disparity);
    });
  };
  std::visit(add, painting.marks);
  return disparities;
}

}  // namespace wheatstone
