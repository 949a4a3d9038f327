#include "wheatstone/strokes/repair.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wheatstone/marks/brush.h"

namespace wheatstone {
namespace {

/// The largest radius, halved as often as need be, with which a dot lies on one surface.
float fitting_radius(const StrokeRepair& repair, int x, int y) {
  const ImageView<const float>& disparity = repair.target.disparity;
  for (float radius = repair.scaled.radii_px.back(); radius > repair.scaled.least_dot_px; radius /= 2) {
    const int reach = static_cast<int>(std::ceil(radius));
    bool fits = true;
    for (int row = std::max(y - reach, 0); fits && row <= std::min(y + reach, disparity.height() - 1); ++row)
      for (int column = std::max(x - reach, 0); fits && column <= std::min(x + reach, disparity.width() - 1); ++column)
        fits = std::abs(disparity(column, row) - disparity(x, y)) <= repair.scaled.depth_threshold_px;
    if (fits) return radius;
  }
  return repair.scaled.least_dot_px;
}

/// How far from its middle a dot covers pixels wholly.
float whole_px(float radius_px) {
  const BrushProfile brush(radius_px);
  return brush.middle_px - brush.rim_px / 2;
}

/// Removes the pixels that a dot covers wholly from the mask.
void strike_out(int x, int y, float radius_px, Image<std::uint8_t>& wanted) {
  const float whole = whole_px(radius_px);
  const int reach = std::max(static_cast<int>(whole), 0);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, wanted.height() - 1); ++row)
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, wanted.width() - 1); ++column)
      if (std::hypot(static_cast<float>(column - x), static_cast<float>(row - y)) <= whole) wanted(column, row) = 0;
  wanted(x, y) = 0;
}

/// The photograph's colour at a pixel. If two surfaces' colours mix there, it is the colour of the nearest unmixed
/// pixel of the same surface, if there is one nearby.
Rgb8 colour_of_surface(const StrokeRepair& repair, int x, int y) {
  const ImageView<const std::uint8_t> mixed_colours = repair.mixed_colours;
  if (mixed_colours.empty() || mixed_colours(x, y) == 0) return repair.target.picture(x, y);
  const int reach = static_cast<int>(std::ceil(repair.scaled.radii_px.back()));
  int nearest = 2 * reach * reach + 1;
  Rgb8 colour = repair.target.picture(x, y);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, mixed_colours.height() - 1); ++row) {
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, mixed_colours.width() - 1); ++column) {
      const int distance = (column - x) * (column - x) + (row - y) * (row - y);
      if (distance >= nearest || mixed_colours(column, row) != 0) continue;
      if (std::abs(repair.target.disparity(column, row) - repair.target.disparity(x, y)) >
          repair.scaled.depth_threshold_px)
        continue;
      nearest = distance;
      colour = repair.target.picture(column, row);
    }
  }
  return colour;
}

/// A brush that follows wanted pixels of one surface and one colour, because a dot for each pixel would mean thousands
/// of dots.
class Thread {
 public:
  /// In a style of dots it stays where it begins.
  Thread(const StrokeRepair& repair, int max_length, Image<std::uint8_t>& wanted)
      : repair_(repair),
        disparity_(repair.target.disparity),
        most_points_(static_cast<std::size_t>(std::clamp(max_length, 1, 8))),
        wanted_(wanted) {}

  Rgb8 colour_at(int x, int y) const { return colour_of_surface(repair_, x, y); }

  /// Moves the brush from a pixel on: removes the pixels that it covers wholly from the mask, and adds its points.
  void follow(int x, int y, float radius_px, std::vector<ControlPoint>& points) {
    const Begin begin{disparity_(x, y), colour_at(x, y), std::max(static_cast<int>(whole_px(radius_px)), 0) + 1};
    const std::size_t first = points.size();
    do {
      points.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, disparity_(x, y)});
      strike_out(x, y, radius_px, wanted_);
    } while (points.size() - first < most_points_ && step(begin, x, y));
  }

 private:
  struct Begin {
    float disparity;
    Rgb8 colour;
    int farthest_step;  ///< to the next pixel that the brush does not cover wholly yet
  };

  /// Moves to a wanted pixel that comes later in row order. Returns false if there is none.
  bool step(const Begin& begin, int& x, int& y) const {
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 1}, {1, 1}}) {
      for (int by = 1; by <= begin.farthest_step; ++by) {
        const int column = x + by * dx, row = y + by * dy;
        if (!wanted_.contains(column, row) || wanted_(column, row) == 0) continue;
        if (!is_alike(begin, column, row)) break;
        x = column;
        y = row;
        return true;
      }
    }
    return false;
  }

  bool is_alike(const Begin& begin, int x, int y) const {
    constexpr float most_disparity_px = 0.5f;  // strokes as good as flat are drawn fast
    constexpr int most_squared_difference = 30 * 30;
    if (std::abs(disparity_(x, y) - begin.disparity) > most_disparity_px) return false;
    const Rgb8 there = colour_at(x, y);
    const int red = there.r - begin.colour.r, green = there.g - begin.colour.g, blue = there.b - begin.colour.b;
    return red * red + green * green + blue * blue <= most_squared_difference;
  }

  const StrokeRepair& repair_;
  ImageView<const float> disparity_;
  std::size_t most_points_;
  Image<std::uint8_t>& wanted_;
};

}  // namespace

Layer repair(const StrokeRepair& repair, const Style& style) {
  const RepairTarget& target = repair.target;
  Image<std::uint8_t> wanted(target.places.width(), target.places.height());
  for (int y = 0; y < wanted.height(); ++y) std::ranges::copy(target.places.row(y), wanted.row(y).begin());
  Thread thread(repair, style.max_length, wanted);
  Layer marks{repair.scaled.radii_px.back(), {}, {}};
  const auto is_wanted = [](std::uint8_t value) { return value != 0; };
  for (int y = 0; y < wanted.height(); ++y) {
    const auto row = wanted.row(y);
    for (auto next = std::ranges::find_if(row, is_wanted); next != row.end();
         next = std::find_if(next, row.end(), is_wanted)) {
      const int x = static_cast<int>(next - row.begin());
      Stroke stroke{.first_point = static_cast<std::uint32_t>(marks.points.size())};
      stroke.radius_px = fitting_radius(repair, x, y);
      stroke.opacity = style.opacity;
      stroke.colour = thread.colour_at(x, y);
      stroke.disparity = target.disparity(x, y);
      stroke.reference_view = target.reference_view;
      stroke.views = target.views;
      thread.follow(x, y, stroke.radius_px, marks.points);
      stroke.point_count = static_cast<std::uint32_t>(marks.points.size()) - stroke.first_point;
      marks.strokes.push_back(stroke);
    }
  }
  for (ControlPoint& point : marks.points) point.x = x_in_view(point, target.view, target.reference_view);
  return marks;
}

}  // namespace wheatstone
