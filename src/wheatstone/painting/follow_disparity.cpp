#include "wheatstone/painting/follow_disparity.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/depth/warp_row.h"

namespace wheatstone {
namespace {

/// By how much the left view's disparities change.
class DepthChange {
 public:
  DepthChange(ImageView<const float> before, ImageView<const float> after)
      : before_(before), after_(after), in_row_(static_cast<std::size_t>(before.height())) {
    tbb::parallel_for(0, before.height(), [&](int y) {
      in_row_[static_cast<std::size_t>(y)] = std::ranges::equal(before_.row(y), after_.row(y)) ? 0 : 1;
    });
  }

  bool is_in_row(int y) const { return in_row_[static_cast<std::size_t>(y)] != 0; }

  /// Of a point of the left view that lies on the surface there; 0 for one that lies on another.
  float at(const ControlPoint& point, float tolerance_px) const {
    const int column = floor_of(point.x), row = floor_of(point.y);
    if (!before_.contains(column, row) || !is_in_row(row)) return 0;
    const float was = before_(column, row);
    return std::abs(point.disparity - was) <= tolerance_px ? after_(column, row) - was : 0;
  }

 private:
  ImageView<const float> before_, after_;
  std::vector<std::uint8_t> in_row_;
};

void move_strokes(const DepthChange& change, float tolerance_px, Layer& layer) {
  for (Stroke& stroke : layer.strokes) {
    float sum = 0;
    for (ControlPoint& point : std::span(layer.points).subspan(stroke.first_point, stroke.point_count)) {
      ControlPoint seen = point;
      seen.x = x_in_view(point, stroke.reference_view, left_eye);
      const float nearer_px = change.at(seen, tolerance_px);
      if (nearer_px == 0) continue;
      seen.disparity += nearer_px;
      point = {x_in_view(seen, left_eye, stroke.reference_view), point.y, seen.disparity};
      sum += nearer_px;
    }
    stroke.disparity += sum / static_cast<float>(stroke.point_count);
  }
}

/// Gives the surface that the left view sees its new disparities.
void move_surface(const DepthChange& change, ImageView<const float> after, Surface& surface) {
  for (int y = 0; y < after.height(); ++y) {
    if (!change.is_in_row(y)) continue;
    for (const KnownRuns::Run& run : surface.disparity.runs_of(y))
      std::ranges::transform(after.row(y)
                                 .subspan(static_cast<std::size_t>(run.begin))
                                 .first(static_cast<std::size_t>(run.end - run.begin)),
                             surface.disparity.values_of(run).begin(), in_whole_steps);
  }
}

}  // namespace

void follow_disparity(ImageView<const float> before, ImageView<const float> after, Painting& painting) {
  auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  if (strokes == nullptr || painting.surfaces.seen.empty()) return;
  const DepthChange change(before, after);
  tbb::parallel_for(std::size_t{0}, strokes->layers.size(),
                    [&](std::size_t i) { move_strokes(change, painting.surfaces.tolerance_px, strokes->layers[i]); });
  move_surface(change, after, painting.surfaces.seen.front());
}

}  // namespace wheatstone
