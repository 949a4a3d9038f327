#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

#include "wheatstone/share/mark_parts_internal.h"
#include "wheatstone/share/number_streams_internal.h"

namespace wheatstone {
namespace {

constexpr int radius_steps = 256;

/// Places that go on from one another: of a stroke's first point the difference from the last stroke's first.
class Places {
 public:
  /// `goes_on`: a step is expected to be as the last one was; else none is expected.
  Places(NumberStream& to, int steps_a_px, bool goes_on) : to_(to), steps_a_px_(steps_a_px), goes_on_(goes_on) {}

  void begin(float place) {
    last_ = in_steps(place, steps_a_px_);
    to_.add_signed(last_ - first_);
    first_ = last_;
    step_ = 0;
  }
  void next(float place) {
    const std::int64_t here = in_steps(place, steps_a_px_), step = here - last_;
    to_.add_signed(goes_on_ ? step - step_ : step);
    last_ = here;
    step_ = step;
  }

 private:
  NumberStream& to_;
  int steps_a_px_;
  bool goes_on_;
  std::int64_t first_ = 0, last_ = 0, step_ = 0;
};

}  // namespace

std::size_t Plans::number_of(const Planned& planned) {
  const auto found = std::ranges::find(plans_, planned);
  if (found != plans_.end()) return static_cast<std::size_t>(found - plans_.begin());
  plans_.push_back(planned);
  return plans_.size() - 1;
}

bool strokes_vary(const StrokePainting& painting) {
  const auto changes = [](const Stroke& stroke) { return stroke.change != ColourChange{}; };
  return painting.brush.varies() || std::ranges::any_of(painting.layers, [&](const Layer& layer) {
           return std::ranges::any_of(layer.strokes, changes);
         });
}

PagePart strokes_part(std::string name, const Layer& layer, bool vary, const Rounding& rounding, Plans& plans) {
  constexpr std::size_t streams_of_even_strokes = 10;
  std::array<NumberStream, streams_of_even_strokes + 4> streams;
  auto& [counts, x, y, disparities, green, red, blue, radii, opacities, planned, numbers, green_change, red_change,
         blue_change] = streams;
  Places column(x, rounding.steps_a_px, true), row(y, rounding.steps_a_px, true),
      depth(disparities, 2 * rounding.steps_a_px, false);
  std::int64_t last_number = 0;
  for (const Stroke& stroke : layer.strokes) {
    counts.add_whole(stroke.point_count);
    planned.add_whole(plans.number_of({stroke.reference_view, stroke.views}));
    const auto points = layer.points_of(stroke);
    column.begin(points.front().x);
    row.begin(points.front().y);
    depth.begin(points.front().disparity);
    for (const ControlPoint& point : points.subspan(1)) {
      column.next(point.x);
      row.next(point.y);
      depth.next(point.disparity);
    }
    // Channels differ less from one another than from stroke to stroke.
    const auto level = [&](int of_256) { return (of_256 + rounding.colour_step / 2) / rounding.colour_step; };
    green.add_signed(level(stroke.colour.g));
    red.add_signed(level(stroke.colour.r) - level(stroke.colour.g));
    blue.add_signed(level(stroke.colour.b) - level(stroke.colour.g));
    radii.add_whole(static_cast<std::uint64_t>(in_steps(stroke.radius_px, radius_steps)));
    opacities.add_whole(static_cast<std::uint64_t>(std::lround(std::clamp(stroke.opacity, 0.f, 1.f) * 65535)));

    numbers.add_signed(stroke.number - last_number);
    last_number = stroke.number;
    const auto change_of = [&](int levels) { return std::lround(static_cast<double>(levels) / rounding.colour_step); };
    green_change.add_signed(change_of(stroke.change.g));
    red_change.add_signed(change_of(stroke.change.r) - change_of(stroke.change.g));
    blue_change.add_signed(change_of(stroke.change.b) - change_of(stroke.change.g));
  }
  return part_of_streams(std::move(name), std::span(streams).first(vary ? streams.size() : streams_of_even_strokes));
}

}  // namespace wheatstone
