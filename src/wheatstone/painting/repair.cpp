#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "wheatstone/curves/repair.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/painting/over_spots_internal.h"
#include "wheatstone/painting/repair_internal.h"
#include "wheatstone/regions/repair.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/repair.h"

namespace wheatstone {
namespace {

bool has_any(const Image<std::uint8_t>& mask) {
  return std::memchr(mask.pixels().data(), 255, mask.pixels().size()) != nullptr;
}

/// The repair target for places of a view.
RepairTarget target_for(const View& view, ViewPosition reference, const Image<std::uint8_t>& places,
                        ImageView<const float> disparity, float depth_threshold_px) {
  const ViewRange seen_from = view.position == reference ? all_views : views_about(view.position, reference);
  return {view.colour, places, disparity, view.position, reference, seen_from, depth_threshold_px};
}

Layer strokes_for(const RepairTarget& target, const Style& style) {
  return repair({target, ScaledStyle(style, target.picture.width())}, style);
}

// One overload for each kind of marks.
void add_repair(const RepairTarget& target, const Style& style, RegionPainting& regions) {
  repair(target, style, regions);
}
void add_repair(const RepairTarget& target, const Style&, DiffusionPainting& lines) { repair(target, lines); }
void add_repair(const RepairTarget& target, const Style& style, StrokePainting& strokes) {
  if (!strokes.layers.empty()) append_strokes(strokes_for(target, style), strokes.layers.back());
}
void add_marks(const RepairTarget& target, const Style& style, Painting& painting) {
  std::visit([&](auto& marks) { add_repair(target, style, marks); }, painting.marks);
}

/// What a view would show if it saw the reference view's colours where its disparities say so.
Image<Rgb8> colours_of_reference(const View& view, const View& reference) {
  Image<Rgb8> colours(view.colour.width(), view.colour.height());
  const float separation = view.position - reference.position;
  tbb::parallel_for(0, colours.height(), [&](int y) {
    const auto from = reference.colour.row(y), own = view.colour.row(y);
    const auto to = colours.row(y);
    for (int x = 0; x < colours.width(); ++x) {
      const float place = static_cast<float>(x) + 0.5f + separation * view.disparity(x, y);
      const bool is_shared =
          (view.wanted.empty() || view.wanted(x, y) == 0) && place >= 0 && place < static_cast<float>(colours.width());
      to[x] = is_shared ? from[static_cast<std::size_t>(place)] : own[x];
    }
  });
  return colours;
}

/// Repairs places of other views where marks of the reference view lie on something else because their disparity is
/// wrong. Nearly all faults of strokes are of this kind: drawing them would reveal little more, and cost more.
void repair_displaced(std::span<const View> views, const Style& style, Painting& painting) {
  constexpr int rim_px = 2;
  const View& reference = views.front();
  for (const View& view : views.subspan(1)) {
    if (view.continued) continue;
    Image<std::uint8_t> places = residual(colours_of_reference(view, reference), view.colour);
    remove_occlusion_specks(places, least_repaired_px);
    if (!has_any(places)) continue;
    places = dilate_occlusion(places, rim_px);
    const Image<float> before = disparity_before(view.disparity, places);
    add_marks(target_for(view, reference.position, places, before, painting.surfaces.tolerance_px), style, painting);
  }
}

/// Draws regions or lines, and repairs what the drawing shows wrongly. Things without edges, such as a soft light, or
/// with edges too short to follow, are missing between the lines, which is known only when the lines' colours have
/// spread. The reference view is repaired first, for all views. This suffices for the eyes beside a central reference
/// view: they are half as far from it as from each other, and move towards it where depth is reduced. An eye as the
/// reference view lacks more of what the other eye shows.
void repair_shown(std::span<const View> views, const Style& style, Painting& painting) {
  const bool of_lines = style.marks == Marks::curves;
  const ViewPosition reference = views.front().position;
  const bool refers_to_eye = reference == left_eye || reference == right_eye;
  for (const View& view : views) {
    const bool is_reference = view.position == reference;
    if (view.continued || (of_lines && !is_reference && !refers_to_eye)) continue;
    Image<std::uint8_t> places = residual(draw(painting, view.position).picture, view.colour);
    if (of_lines) remove_occlusion_specks(places, least_repaired_px);
    if (!has_any(places)) continue;
    const Image<float> before = is_reference || of_lines ? Image<float>() : disparity_before(view.disparity, places);
    add_marks(target_for(view, reference, places, before.empty() ? ImageView<const float>(view.disparity) : before,
                         painting.surfaces.tolerance_px),
              style, painting);
  }
}

/// A mask of pixels of the reference view, as the view's own pictures have them.
Image<std::uint8_t> in_pixels_of(const View& view, const Image<std::uint8_t>& mask) {
  Image<std::uint8_t> own(view.colour.width(), view.colour.height());
  for (int y = 0; y < own.height(); ++y)
    for (int x = 0; x < own.width(); ++x)
      if (mask.contains(x + view.frame.origin_px, y)) own(x, y) = mask(x + view.frame.origin_px, y);
  return own;
}

/// The views that are nearer to this one than to any other of these.
ViewRange halfway_to_others(std::span<const ViewPosition> positions, ViewPosition view) {
  ViewRange range = all_views;
  for (const ViewPosition other : positions) {
    const ViewPosition middle((other.eye_separations() + view.eye_separations()) / 2);
    if (other < view) range.first = std::max(range.first, middle);
    if (view < other) range.last = std::min(range.last, middle);
  }
  return range;
}

struct Rows {
  int first, end;
};

/// The rows that strokes may touch.
Rows rows_of(const Layer& strokes, int height) {
  const auto [top, bottom] = std::ranges::minmax(strokes.points, {}, &ControlPoint::y);
  const float reach = std::ranges::max(strokes.strokes, {}, &Stroke::radius_px).radius_px + 2;
  return {std::max(static_cast<int>(top.y - reach), 0), std::min(static_cast<int>(bottom.y + reach) + 1, height)};
}

ImageView<const Rgb8> part_of(ImageView<const Rgb8> picture, Rows rows) {
  return {picture.row(rows.first).data(), picture.width(), rows.end - rows.first, picture.stride()};
}

/// The residual of some rows.
Image<std::uint8_t> residual_in(Rows rows, const Image<Rgb8>& painted, ImageView<const Rgb8> target) {
  const int width = painted.width(), near_px = static_cast<int>(std::ceil(nearness_px(width)));
  const Rows judged{std::max(rows.first - near_px, 0), std::min(rows.end + near_px, painted.height())};
  const Image<std::uint8_t> in_judged = residual(part_of(painted, judged), part_of(target, judged));
  Image<std::uint8_t> wrong(width, painted.height());
  for (int y = rows.first; y < rows.end; ++y) std::ranges::copy(in_judged.row(y - judged.first), wrong.row(y).begin());
  return wrong;
}

}  // namespace

void repair(std::span<const View> views, const Style& style, Painting& painting) {
  if (style.propagation == Propagation::independent || style.marks == Marks::tiles) return;
  const bool of_regions = style.marks == Marks::regions;
  if (!of_regions && views.front().colour.width() < least_repaired_width_px) return;
  const bool changes_colours = is_of_strokes(style) && style.jitter != ColourJitter{};
  if (!of_regions && !changes_colours) repair_displaced(views, style, painting);
  if (!is_of_strokes(style)) repair_shown(views, style, painting);
}

void cover_bare(std::span<const View> views, const Style& style, Painting& painting) {
  auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  if (strokes == nullptr || strokes->layers.empty()) return;
  // The eyes are near enough to the reference view.
  std::vector<View> scene{views.front()};
  std::ranges::copy_if(views.subspan(1), std::back_inserter(scene), &View::continued);
  scene = at_reference_scale(scene);
  std::vector<ViewPosition> positions;
  for (const View& view : scene) positions.push_back(view.position);
  PreparedPainting prepared = prepare(painting, {.relief = false});
  std::vector<DrawnView> drawn = draw(prepared, positions);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    const View& view = scene[i];
    const auto cover = [&](ImageView<const std::uint8_t> bare, ImageView<const float> disparity, ViewRange seen_from) {
      Layer marks = strokes_for({view.colour, bare, disparity, view.position, positions.front(), seen_from}, style);
      if (marks.strokes.empty()) return;
      for (ControlPoint& point : marks.points) point.x += static_cast<float>(view.frame.origin_px);
      append_strokes(marks, strokes->layers.back());
      draw_over(prepared, marks, view.position, {}, drawn[i]);
    };
    cover(in_pixels_of(view, drawn[i].bare), view.disparity, all_views);
    // What is bare still is hidden by surfaces of neighbouring pixels.
    const Image<std::uint8_t> hidden = in_pixels_of(view, drawn[i].bare);
    cover(hidden, disparity_before(view.disparity, hidden), halfway_to_others(positions, view.position));
  }
}

bool is_repaired_when_drawn(const Painting& painting, const Style& style) {
  // Where less is near than the finest brush is wide, noise makes spots come and go.
  constexpr double least_near_px = 2;
  const auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  return strokes != nullptr && !strokes->layers.empty() && nearness_px(strokes->width) >= least_near_px &&
         style.jitter == ColourJitter{} && style.propagation != Propagation::independent &&
         painting.relief.depth_px <= 0;
}

void repair_drawn(std::span<ShownView> shown, ViewPosition reference, const Style& style, Painting& painting,
                  PreparedPainting& prepared) {
  constexpr int most_rounds = 3;  // dots may reach over their neighbours
  Style dots = style;             // the curve of longer strokes passes beside their points
  dots.max_length = 1;
  std::vector<Layer>& layers = std::get<StrokePainting>(painting.marks).layers;
  for (auto& [view, background, drawn] : shown) {
    Image<std::uint8_t> places = residual(drawn.picture, view.colour);
    for (int round = 0; round < most_rounds; ++round) {
      remove_occlusion_specks(places, least_repaired_px);
      if (!has_any(places)) break;
      const Image<float> before = disparity_before(view.disparity, places);
      const Layer strokes =
          strokes_for(target_for(view, reference, places, before, painting.surfaces.tolerance_px), dots);
      append_strokes(strokes, layers.back());
      draw_over(prepared, strokes, view.position, background, drawn);
      places = residual_in(rows_of(strokes, view.colour.height()), drawn.picture, view.colour);
    }
  }
}

}  // namespace wheatstone
