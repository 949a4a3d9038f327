#include "wheatstone/painting/plan_painting.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <span>
#include <utility>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/relief.h"
#include "wheatstone/motion/fitting_scene.h"
#include "wheatstone/painting/mend_spots_internal.h"
#include "wheatstone/painting/plan_unmended_internal.h"
#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {
namespace {

/// Disparities in whole steps, as paintings keep them.
void round_to_steps(std::span<const float> from, std::span<float> to) {
  for (std::size_t x = 0; x < from.size(); ++x)
    to[x] = static_cast<float>(floor_of(from[x] * disparity_steps + 0.5f)) / disparity_steps;
}

/// What a view is the first to see.
Surface surface_of(const SceneView& view) {
  const int width = view.disparity.width(), height = view.disparity.height();
  Surface surface{view.position, Image<float>(width, height), view.left_px, view.continued};
  tbb::parallel_for(0, height, [&](int y) {
    const auto from = view.disparity.row(y);
    const auto to = surface.disparity.row(y);
    if (view.only_here.empty()) {
      round_to_steps(from, to);
      return;
    }
    // Most of what other views than the reference show is not their own.
    std::ranges::fill(to, std::numeric_limits<float>::quiet_NaN());
    const auto own = view.only_here.row(y);
    for (auto end = own.begin();;) {
      const auto begin = std::find_if(end, own.end(), [](std::uint8_t value) { return value != 0; });
      if (begin == own.end()) return;
      end = std::find(begin, own.end(), std::uint8_t{0});
      const auto first = static_cast<std::size_t>(begin - own.begin()), count = static_cast<std::size_t>(end - begin);
      round_to_steps(from.subspan(first, count), to.subspan(first, count));
    }
  });
  return surface;
}

Surfaces surfaces_of(std::span<const SceneView> views, const Style& style) {
  Surfaces surfaces;
  for (const SceneView& view : views) surfaces.seen.push_back(surface_of(view));
  surfaces.tolerance_px = ScaledStyle(style, views.front().picture.width()).depth_threshold_px;
  return surfaces;
}

}  // namespace

PlannedFrame plan_unmended(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           PaintingMemory& memory, const Progress& progress) {
  check_style(style);
  check_fits(frame.views);
  report(progress, "painting", 0);
  PlannedFrame planned;
  Painting& painting = planned.painting;
  switch (style.marks) {
    case Marks::strokes: {
      CarriedPainting carried = plan_strokes(frame, style, options, memory.strokes, progress);
      painting.marks = std::move(carried.painting);
      planned.counts = carried.counts;
      break;
    }
    case Marks::regions:
      painting.marks = plan_posterised(frame, style, memory.posterised);
      break;
    case Marks::tiles:
      painting.marks = plan_mosaic(frame, style, memory.mosaic);
      break;
    case Marks::curves:
      painting.marks = plan_diffusion(frame, style, memory.diffusion);
      break;
  }
  for (const SceneView& view : frame.views)
    if (view.left_px != 0) shift_marks(view.position, static_cast<float>(view.left_px), painting);
  painting.surfaces = surfaces_of(frame.views, style);
  painting.relief = relief_for(style, width_of(painting));
  return planned;
}

PlannedFrame plan_painting(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                           PaintingMemory& memory, const Progress& progress) {
  PlannedFrame planned = plan_unmended(frame, style, options, memory, progress);
  mend_spots(frame.views, style, planned.painting);
  return planned;
}

}  // namespace wheatstone
