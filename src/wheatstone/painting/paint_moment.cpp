#include "wheatstone/painting/paint_moment.h"

#include <tbb/parallel_for.h>

#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/painting/draw_in_style_internal.h"
#include "wheatstone/stopwatch.h"

namespace wheatstone {
namespace {

/// The scene's views that are shown: the eyes, or the one view there is.
std::vector<std::size_t> shown_views(const Moment& moment) {
  std::vector<std::size_t> shown;
  for (const float eye : {left_eye, right_eye})
    for (std::size_t i = 0; i < moment.views.size(); ++i)
      if (moment.views[i].position == eye) shown.push_back(i);
  if (shown.empty()) shown.push_back(0);
  return shown;
}

/// Draws the views; what strokes left bare in any of them gets dots, and all are drawn again.
std::vector<DrawnView> draw_covered(const Moment& moment, const std::vector<std::size_t>& shown, const Style& style,
                                    const CarryOptions& options, StrokeMemory& memory, Painting& painting) {
  std::vector<DrawnView> drawn(shown.size());
  const auto draw_all = [&] {
    tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
      const SceneView& view = moment.views[shown[i]];
      drawn[i] = draw_in_style(view.picture, painting, view.position, style);
    });
  };
  draw_all();
  bool covered = true;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    if (drawn[i].bare_share == 0) continue;
    insert_strokes(cover_bare(moment, shown[i], drawn[i].bare, style, options, memory), style, painting.layers.back());
    covered = false;
  }
  if (!covered) draw_all();
  return drawn;
}

void take_pictures(std::vector<DrawnView> drawn, PaintedPair& painted) {
  painted.pictures.left = std::move(drawn.front().picture);
  painted.left_bare_share = drawn.front().bare_share;
  if (drawn.size() < 2) return;
  painted.pictures.right = std::move(drawn.back().picture);
  painted.right_bare_share = drawn.back().bare_share;
}

PaintedMoment paint_strokes(const Moment& moment, const Style& style, const CarryOptions& options,
                            StrokeMemory& memory) {
  PaintedMoment result;
  PaintedPair& painted = result.painted;
  {
    const Stopwatch watch(painted.times.planning_s);
    CarriedPainting carried = plan_strokes(moment, style, options, memory);
    painted.painting = std::move(carried.painting);
    result.counts = carried.counts;
  }
  const Stopwatch watch(painted.times.rasterising_s);
  take_pictures(draw_covered(moment, shown_views(moment), style, options, memory, painted.painting), painted);
  return result;
}

/// Plans the kinds of marks that are not strokes.
void plan_other_marks(const Moment& moment, const Style& style, MomentMemory& memory, PaintedPair& painted) {
  if (style.marks == Marks::areas) painted.areas = plan_posterised(moment, style, memory.posterised);
  if (style.marks == Marks::tiles) painted.areas = plan_mosaic(moment, style, memory.mosaic);
  if (style.marks == Marks::curves) painted.curves = plan_diffusion(moment, style, memory.diffusion);
}

PaintedMoment paint_other_marks(const Moment& moment, const Style& style, MomentMemory& memory) {
  PaintedMoment result;
  PaintedPair& painted = result.painted;
  painted.painting.width = moment.views.front().picture.width();
  painted.painting.height = moment.views.front().picture.height();
  {
    const Stopwatch watch(painted.times.planning_s);
    plan_other_marks(moment, style, memory, painted);
  }
  const Stopwatch watch(painted.times.rasterising_s);
  const std::vector<std::size_t> shown = shown_views(moment);
  std::vector<DrawnView> drawn(shown.size());
  tbb::parallel_for(std::size_t{0}, shown.size(), [&](std::size_t i) {
    const float view = moment.views[shown[i]].position;
    drawn[i] = style.marks == Marks::curves ? draw(painted.curves, view) : draw(painted.areas, view);
  });
  take_pictures(std::move(drawn), painted);
  return result;
}

}  // namespace

PaintedMoment paint_moment(const Moment& moment, const Style& style, const CarryOptions& options,
                           MomentMemory& memory) {
  check_style(style);
  return style.marks == Marks::strokes ? paint_strokes(moment, style, options, memory.strokes)
                                       : paint_other_marks(moment, style, memory);
}

}  // namespace wheatstone
