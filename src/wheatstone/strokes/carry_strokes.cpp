#include "wheatstone/strokes/carry_strokes_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/seed_internal.h"
#include "wheatstone/strokes/visible_runs_internal.h"

namespace wheatstone {
namespace {

float median(float a, float b, float c) { return std::max(std::min(a, b), std::min(std::max(a, b), c)); }

/// The median of three steps, or the mean of two, in x and y separately.
PointStep middle_of(std::span<const PointStep> steps) {
  if (steps.size() == 1) return steps[0];
  if (steps.size() == 2) return {(steps[0].x + steps[1].x) / 2, (steps[0].y + steps[1].y) / 2, true};
  return {median(steps[0].x, steps[1].x, steps[2].x), median(steps[0].y, steps[1].y, steps[2].y), true};
}

/// Median over three neighbours on the stroke (Bukenberger et al. 2015, sec. 3.1); if any of them is confirmed, over
/// the confirmed ones only.
PointStep smoothed(std::span<const PointStep> steps, std::size_t i) {
  const std::size_t first = i == 0 ? 0 : i - 1, last = std::min(i + 1, steps.size() - 1);
  std::array<PointStep, 3> confirmed;
  std::size_t count = 0;
  for (std::size_t k = first; k <= last; ++k)
    if (steps[k].confirmed) confirmed[count++] = steps[k];
  if (count > 0) return middle_of(std::span(confirmed).first(count));
  return middle_of(steps.subspan(first, last - first + 1));
}

bool is_inside(float x, float y, const ImageView<const float>& picture) {
  return x >= 0 && y >= 0 && x < static_cast<float>(picture.width()) && y < static_cast<float>(picture.height());
}

/// Where a point came to lie.
enum class PlaceInDepth { on_surface, before_it, behind_it };

/// Moves a disparity towards its target only as far as necessary, so that noise in matching moves no paint.
float follow(float disparity, float target, float depth_threshold_px) {
  const float slack_px = depth_threshold_px / 8;
  return std::clamp(disparity, target - slack_px, target + slack_px);
}

/// Gives a moved point the disparity of its surface if that surface is at the point or a pixel beside it, because edges
/// are known to a pixel at best.
PlaceInDepth follow_surface(const View& now, float depth_threshold_px, ControlPoint& point) {
  const float x_there = now.frame.column(point.x);
  const float there = surface_disparity(now.disparity, x_there, point.y, depth_threshold_px);
  if (std::abs(there - point.disparity) <= depth_threshold_px) {
    point.disparity = follow(point.disparity, there, depth_threshold_px);
    return PlaceInDepth::on_surface;
  }
  const int column = static_cast<int>(x_there), row = static_cast<int>(point.y);
  float nearest = there;
  for (int y = std::max(row - 1, 0); y <= std::min(row + 1, now.disparity.height() - 1); ++y)
    for (int x = std::max(column - 1, 0); x <= std::min(column + 1, now.disparity.width() - 1); ++x)
      if (std::abs(now.disparity(x, y) - point.disparity) < std::abs(nearest - point.disparity))
        nearest = now.disparity(x, y);
  if (std::abs(nearest - point.disparity) > depth_threshold_px)
    return there > point.disparity ? PlaceInDepth::behind_it : PlaceInDepth::before_it;
  point.disparity = follow(point.disparity, nearest, depth_threshold_px);
  return PlaceInDepth::on_surface;
}

/// Moves one stroke. Returns false if too many of its points came to lie on other surfaces.
bool move_stroke(const SceneMotion& motion, const View& now, float depth_threshold_px, std::span<ControlPoint> points) {
  std::vector<PointStep> steps(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) steps[i] = motion.of(points[i], now.position);
  std::size_t slipped = 0, buried = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    ControlPoint& point = points[i];
    const PointStep step = smoothed(steps, i);
    point.x += step.x;
    point.y += step.y;
    if (!is_inside(now.frame.column(point.x), point.y, now.disparity)) continue;
    const PlaceInDepth place = follow_surface(now, depth_threshold_px, point);
    buried += place == PlaceInDepth::behind_it ? 1 : 0;
    slipped += place == PlaceInDepth::before_it ? 1 : 0;
  }
  return 8 * slipped <= points.size() && 2 * buried <= points.size();
}

}  // namespace

float length_px(std::span<const ControlPoint> points) {
  float length = 0;
  for (std::size_t i = 1; i < points.size(); ++i)
    length += std::hypot(points[i].x - points[i - 1].x, points[i].y - points[i - 1].y);
  return length;
}

void carry_layer(const SceneMotion& motion, const View& now, float depth_threshold_px, const CarryOptions& options,
                 TrackedLayer& tracked) {
  Layer& layer = tracked.layer;
  tbb::parallel_for(std::size_t{0}, tracked.tracks.size(), [&](std::size_t i) {
    Stroke& stroke = layer.strokes[i];
    const std::span points = std::span(layer.points).subspan(stroke.first_point, stroke.point_count);
    StrokeTrack& track = tracked.tracks[i];
    // The reference view has its own paint on parts that it showed already, and this stroke would lie over that paint.
    if (now.position != motion.reference() && motion.showed_whole(points, stroke.radius_px, now.position)) {
      track = {.shown = 0, .ends = 1};
      return;
    }
    const ControlPoint before = points.front();
    const bool fits = move_stroke(motion, now, depth_threshold_px, points);
    // Strokes are ordered by their disparities, and noise must not change the order.
    stroke.disparity = follow(stroke.disparity, points.front().disparity, depth_threshold_px);
    constexpr float rounding_px = 1;
    const float most_change_px = std::max(options.length_tolerance * track.first_length_px, rounding_px);
    if (!fits || std::abs(length_px(points) - track.first_length_px) > most_change_px) {
      const float speed_px = std::hypot(points.front().x - before.x, points.front().y - before.y);
      if (track.ends == 0) track.ends = fading_frames(stroke.radius_px, speed_px, options);
    }
  });
}

float first_shown(bool scene_begins, const CarryOptions& options) {
  return scene_begins ? 1 : 1.f / static_cast<float>(std::max(options.fade_in_frames, 1));
}

std::uint32_t fading_frames(float radius_px, float speed_px, const CarryOptions& options) {
  const int slowest = std::max(options.fade_out_frames, 1), fastest = std::clamp(options.fade_in_frames, 1, slowest);
  const float frames = static_cast<float>(slowest) * radius_px / (radius_px + 2 * speed_px);
  return static_cast<std::uint32_t>(std::clamp(static_cast<int>(std::lround(frames)), fastest, slowest));
}

void fade(const CarryOptions& options, TrackedLayer& tracked) {
  for (StrokeTrack& track : tracked.tracks) {
    const bool ends = track.ends != 0;
    const float step =
        1.f / (ends ? static_cast<float>(track.ends) : static_cast<float>(std::max(options.fade_in_frames, 1)));
    track.shown = ends ? track.shown - step : std::min(track.shown + step, 1.f);
  }
  constexpr float nothing = 1e-4f;
  keep_if(tracked, [&](std::size_t i) { return tracked.tracks[i].shown > nothing; });
}

namespace {

/// How unlike the picture a stroke and the paint under it are at some of its points.
struct FitSums {
  float own = 0, gain = 0;
  int count = 0, covered = 0;
};

FitSums sum_fits(std::span<const ControlPoint> points, Rgb8 colour, const ViewOnCanvas& at,
                 const ReferencePicture& reference, const Image<float>& errors) {
  FitSums sums;
  for (const ControlPoint& point : points) {
    if (!is_inside(point.x, point.y, at.view.disparity)) continue;
    const int column = static_cast<int>(point.x), row = static_cast<int>(point.y);
    if (at.view.disparity(column, row) > point.disparity + at.scaled.depth_threshold_px) continue;
    const auto red = static_cast<float>(reference.red(column, row) - colour.r);
    const auto green = static_cast<float>(reference.green(column, row) - colour.g);
    const auto blue = static_cast<float>(reference.blue(column, row) - colour.b);
    const float difference = std::sqrt(red * red + green * green + blue * blue);
    sums.own += difference;
    ++sums.count;
    const float under = errors(column, row);
    if (under < 0 || under >= bare_error) continue;
    sums.gain += std::sqrt(under) - difference;
    ++sums.covered;
  }
  return sums;
}

}  // namespace

ColourFit colour_fit(std::span<const ControlPoint> points, Rgb8 colour, const ViewOnCanvas& at,
                     const ReferencePicture& reference, const Image<float>& errors) {
  constexpr std::size_t points_a_part = 3, most_parts = 4;
  const std::size_t parts = std::clamp<std::size_t>(points.size() / points_a_part, 1, most_parts);
  ColourFit fit;
  bool covered = false;
  for (std::size_t part = 0; part < parts; ++part) {
    const std::size_t begin = part * points.size() / parts, end = (part + 1) * points.size() / parts;
    const FitSums sums = sum_fits(points.subspan(begin, end - begin), colour, at, reference, errors);
    if (sums.count > 0) fit.difference = std::max(fit.difference, sums.own / static_cast<float>(sums.count));
    if (sums.covered == 0) continue;
    const float gain = sums.gain / static_cast<float>(sums.covered);
    fit.gain = covered ? std::min(fit.gain, gain) : gain;
    covered = true;
  }
  return fit;
}

bool is_shown_whole(std::span<const ControlPoint> points, float radius_px, ViewPosition from, const Onlooker& view) {
  const float reach_px = radius_px + depth_edge_px;
  return std::ranges::all_of(points, [&](ControlPoint p) {
    const float x = p.x, column = view.view.frame.column(x_in_view(p, from, view.view.position));
    if (!(column >= 0 && column < static_cast<float>(view.view.disparity.width()))) return false;
    return std::ranges::all_of(std::array{-reach_px, 0.f, reach_px}, [&](float aside) {
      p.x = x + aside;
      return is_visible(p, from, view.view, view.tolerance_px);
    });
  });
}

namespace {

/// The points of a stroke that a view shows.
std::size_t visible_points(std::span<const ControlPoint> points, ViewPosition from, const View& view,
                           float tolerance_px) {
  return static_cast<std::size_t>(
      std::ranges::count_if(points, [&](const ControlPoint& p) { return is_visible(p, from, view, tolerance_px); }));
}

/// True where some of a stroke's paint may lie in one of the views' pictures.
bool reaches_a_picture(std::span<const ControlPoint> points, ViewPosition from, float radius_px,
                       std::span<const View> views) {
  const float reach = radius_px + 1;
  return std::ranges::any_of(views, [&](const View& view) {
    const auto width = static_cast<float>(view.disparity.width()), height = static_cast<float>(view.disparity.height());
    return std::ranges::any_of(points, [&](const ControlPoint& p) {
      const float x = view.frame.column(x_in_view(p, from, view.position));
      return x > -reach && p.y > -reach && x < width + reach && p.y < height + reach;
    });
  });
}

/// The index of the view that a stroke belongs to now; the number of views if it belongs to none.
std::size_t home_of(const Stroke& stroke, std::span<const ControlPoint> points, std::size_t home,
                    std::span<const View> views, float tolerance_px) {
  const ViewPosition from = views[home].position;
  if (!reaches_a_picture(points, from, stroke.radius_px, views)) return views.size();
  const auto visible = [&](std::size_t view) { return visible_points(points, from, views[view], tolerance_px); };
  const std::size_t in_reference = visible(0);
  if (home == 0
          ? 2 * in_reference >= points.size()
          : in_reference == points.size() && is_shown_whole(points, stroke.radius_px, from, {views[0], tolerance_px}))
    return 0;
  if (home != 0 && visible(home) > 0) return home;
  for (std::size_t view = 1; view < views.size(); ++view)
    if (2 * visible(view) > points.size()) return view;
  return in_reference > 0 ? 0 : views.size();
}

/// Moves a stroke of a view's layer to that of the view at `home`.
void move_home(const TrackedLayer& from, std::size_t i, ViewPosition home, TrackedLayer& to) {
  Stroke stroke = from.layer.strokes[i];
  const std::span<const ControlPoint> points = from.layer.points_of(stroke);
  const auto first = static_cast<std::uint32_t>(to.layer.points.size());
  for (ControlPoint point : points) {
    point.x = x_in_view(point, stroke.reference_view, home);
    to.layer.points.push_back(point);
  }
  stroke.first_point = first;
  stroke.reference_view = home;
  to.layer.strokes.push_back(stroke);
  to.tracks.push_back(from.tracks[i]);
}

}  // namespace

void settle(std::span<const View> views, float depth_threshold_px, std::span<TrackedLayer* const> layers) {
  std::vector<std::vector<std::size_t>> homes(views.size());
  for (std::size_t view = 0; view < views.size(); ++view) {
    const TrackedLayer& tracked = *layers[view];
    homes[view].resize(tracked.tracks.size());
    tbb::parallel_for(std::size_t{0}, tracked.tracks.size(), [&](std::size_t i) {
      const Stroke& stroke = tracked.layer.strokes[i];
      homes[view][i] = home_of(stroke, tracked.layer.points_of(stroke), view, views, depth_threshold_px);
    });
  }
  std::vector<TrackedLayer> arrived(views.size());
  for (std::size_t view = 0; view < views.size(); ++view) {
    for (std::size_t i = 0; i < homes[view].size(); ++i)
      if (homes[view][i] != view && homes[view][i] < views.size())
        move_home(*layers[view], i, views[homes[view][i]].position, arrived[homes[view][i]]);
    keep_if(*layers[view], [&](std::size_t i) { return homes[view][i] == view; });
  }
  for (std::size_t view = 0; view < views.size(); ++view) {
    TrackedLayer& tracked = *layers[view];
    append_strokes(arrived[view].layer, tracked.layer);
    tracked.tracks.insert(tracked.tracks.end(), arrived[view].tracks.begin(), arrived[view].tracks.end());
  }
}

}  // namespace wheatstone
