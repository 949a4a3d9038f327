#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/strokes/cover_bare_internal.h"

namespace wheatstone {
namespace {

/// The largest radius, halved as often as need be, with which a dot lies on one surface.
float fitting_radius(const BarePlaces& places, int x, int y, const ScaledStyle& scaled) {
  const ImageView<const float>& disparity = places.disparity;
  for (float radius = scaled.radii_px.back(); radius > places.least_dot_px; radius /= 2) {
    const int reach = static_cast<int>(std::ceil(radius));
    bool fits = true;
    for (int row = std::max(y - reach, 0); fits && row <= std::min(y + reach, disparity.height() - 1); ++row)
      for (int column = std::max(x - reach, 0); fits && column <= std::min(x + reach, disparity.width() - 1); ++column)
        fits = std::abs(disparity(column, row) - disparity(x, y)) <= scaled.depth_threshold_px;
    if (fits) return radius;
  }
  return places.least_dot_px;
}

/// How far from its middle a dot covers pixels wholly.
float whole_px(float radius_px) {
  const BrushProfile brush(radius_px);
  return brush.middle_px - brush.rim_px / 2;
}

/// Takes the pixels that a dot covers wholly off the mask.
void strike_out(int x, int y, float radius_px, Image<std::uint8_t>& bare) {
  const float whole = whole_px(radius_px);
  const int reach = std::max(static_cast<int>(whole), 0);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, bare.height() - 1); ++row)
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, bare.width() - 1); ++column)
      if (std::hypot(static_cast<float>(column - x), static_cast<float>(row - y)) <= whole) bare(column, row) = 0;
  bare(x, y) = 0;
}

/// The photograph's colour at a pixel, or where two surfaces' colours mix there, of the nearest pixel of its surface
/// where they do not; its own where none is near.
Rgb8 colour_of_surface(const BarePlaces& places, int x, int y, const ScaledStyle& scaled) {
  const ImageView<const std::uint8_t> mixed_colours = places.mixed_colours;
  if (mixed_colours.empty() || mixed_colours(x, y) == 0) return places.photograph(x, y);
  const int reach = static_cast<int>(std::ceil(scaled.radii_px.back()));
  int nearest = 2 * reach * reach + 1;
  Rgb8 colour = places.photograph(x, y);
  for (int row = std::max(y - reach, 0); row <= std::min(y + reach, mixed_colours.height() - 1); ++row) {
    for (int column = std::max(x - reach, 0); column <= std::min(x + reach, mixed_colours.width() - 1); ++column) {
      const int distance = (column - x) * (column - x) + (row - y) * (row - y);
      if (distance >= nearest || mixed_colours(column, row) != 0) continue;
      if (std::abs(places.disparity(column, row) - places.disparity(x, y)) > scaled.depth_threshold_px) continue;
      nearest = distance;
      colour = places.photograph(column, row);
    }
  }
  return colour;
}

}  // namespace

Image<std::uint8_t> bare_pixels(const Canvas& canvas, ImageView<const std::uint8_t> wanted) {
  Image<std::uint8_t> bare(canvas.width, canvas.height);
  tbb::parallel_for(0, canvas.height, [&](int y) {
    const auto coverage = canvas.coverage.row(y);
    const auto marks = bare.row(y);
    for (std::size_t x = 0; x < marks.size(); ++x) marks[x] = coverage[x] < 0.5f ? 255 : 0;
    if (wanted.empty()) return;
    const auto wanted_here = wanted.row(y);
    for (std::size_t x = 0; x < marks.size(); ++x) marks[x] = wanted_here[x] != 0 ? marks[x] : std::uint8_t{0};
  });
  return bare;
}

Layer strokes_near_bare(const Layer& layer, ImageView<const std::uint8_t> bare) {
  constexpr int block_px = 16;
  const int columns = bare.width() / block_px + 1, rows = bare.height() / block_px + 1;
  Image<std::uint8_t> has_bare(columns, rows);
  tbb::parallel_for(0, rows, [&](int row) {
    const auto marks = has_bare.row(row);
    for (int y = row * block_px; y < std::min((row + 1) * block_px, bare.height()); ++y) {
      const auto here = bare.row(y);
      for (std::size_t x = 0; x < here.size(); ++x) marks[x / block_px] |= here[x];
    }
  });
  const auto block = [](float place, int count) {
    return std::clamp(static_cast<int>(std::floor(place / block_px)), 0, count - 1);
  };
  const auto may_cover = [&](const Stroke& stroke) {
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    const auto [left, right] = std::ranges::minmax_element(points, {}, &ControlPoint::x);
    const auto [top, bottom] = std::ranges::minmax_element(points, {}, &ControlPoint::y);
    const float reach = stroke.radius_px + 1;
    for (int row = block(top->y - reach, rows); row <= block(bottom->y + reach, rows); ++row)
      for (int column = block(left->x - reach, columns); column <= block(right->x + reach, columns); ++column)
        if (has_bare(column, row) != 0) return true;
    return false;
  };
  std::vector<std::uint8_t> is_near(layer.strokes.size());
  tbb::parallel_for(std::size_t{0}, is_near.size(), [&](std::size_t i) { is_near[i] = may_cover(layer.strokes[i]); });
  Layer near{layer.radius_px, {}, {}};  // few strokes: all points would be many
  for (std::size_t i = 0; i < is_near.size(); ++i) {
    if (is_near[i] == 0) continue;
    Stroke stroke = layer.strokes[i];
    const std::span<const ControlPoint> points = layer.points_of(stroke);
    stroke.first_point = static_cast<std::uint32_t>(near.points.size());
    near.points.insert(near.points.end(), points.begin(), points.end());
    near.strokes.push_back(stroke);
  }
  return near;
}

namespace {

/// A brush that goes along bare pixels of one surface and one colour: a dot for each would be thousands.
class BareThread {
 public:
  /// In a style of dots it stays where it begins.
  BareThread(const ScaledStyle& scaled, const Style& style, BarePlaces& places)
      : scaled_(scaled),
        most_points_(static_cast<std::size_t>(std::clamp(style.max_length, 1, 8))),
        places_(places),
        bare_(places.bare) {}

  Rgb8 colour_at(int x, int y) const { return colour_of_surface(places_, x, y, scaled_); }

  /// Takes the pixels off the mask that the brush covers wholly on its way from a pixel on; adds its points.
  void follow(int x, int y, float radius_px, std::vector<ControlPoint>& points) {
    const Begin begin{places_.disparity(x, y), colour_at(x, y), std::max(static_cast<int>(whole_px(radius_px)), 0) + 1};
    const std::size_t first = points.size();
    do {
      points.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, places_.disparity(x, y)});
      strike_out(x, y, radius_px, bare_);
    } while (points.size() - first < most_points_ && step(begin, x, y));
  }

 private:
  struct Begin {
    float disparity;
    Rgb8 colour;
    int farthest_step;  ///< to the next pixel that the brush does not cover wholly yet
  };

  /// To a bare pixel that comes later, row by row.
  bool step(const Begin& begin, int& x, int& y) const {
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {-1, 1}, {1, 1}}) {
      for (int by = 1; by <= begin.farthest_step; ++by) {
        const int column = x + by * dx, row = y + by * dy;
        if (!bare_.contains(column, row) || bare_(column, row) == 0) continue;
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
    if (std::abs(places_.disparity(x, y) - begin.disparity) > most_disparity_px) return false;
    const Rgb8 there = colour_at(x, y);
    const int red = there.r - begin.colour.r, green = there.g - begin.colour.g, blue = there.b - begin.colour.b;
    return red * red + green * green + blue * blue <= most_squared_difference;
  }

  const ScaledStyle& scaled_;
  std::size_t most_points_;
  const BarePlaces& places_;
  Image<std::uint8_t>& bare_;
};

}  // namespace

Layer cover_places(BarePlaces places, const ScaledStyle& scaled, const Style& style) {
  BareThread thread(scaled, style, places);
  Layer cover{scaled.radii_px.back(), {}, {}};
  const auto is_bare = [](std::uint8_t value) { return value != 0; };
  for (int y = 0; y < places.bare.height(); ++y) {
    const auto row = places.bare.row(y);
    for (auto next = std::ranges::find_if(row, is_bare); next != row.end();
         next = std::find_if(next, row.end(), is_bare)) {
      const int x = static_cast<int>(next - row.begin());
      Stroke stroke{.first_point = static_cast<std::uint32_t>(cover.points.size())};
      stroke.radius_px = fitting_radius(places, x, y, scaled);
      stroke.opacity = style.opacity;
      stroke.colour = thread.colour_at(x, y);
      stroke.disparity = places.disparity(x, y);
      stroke.reference_view = places.view;
      stroke.views = all_views;
      thread.follow(x, y, stroke.radius_px, cover.points);
      stroke.point_count = static_cast<std::uint32_t>(cover.points.size()) - stroke.first_point;
      cover.strokes.push_back(stroke);
    }
  }
  return cover;
}

Layer cover_bare(const LayerPlanner& planner, const LayerInputs& inputs, const ScaledStyle& scaled, const Style& style,
                 Image<std::uint8_t> bare) {
  return cover_places({planner.photograph, planner.disparity, planner.view, inputs.mixed_colours, std::move(bare),
                       planner.least_dot_px},
                      scaled, style);
}

}  // namespace wheatstone
