#include "wheatstone/painting/plan_painting.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/drawing/relief.h"
#include "wheatstone/error.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/painting/repair_internal.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/layer_plan.h"

namespace wheatstone {
namespace {

/// Disparities in whole steps, as paintings keep them; of a view of another scale, each for several pixels.
void round_to_steps(std::span<const float> from, int scale, std::span<float> to) {
  const auto in_steps = [steps = disparity_steps * static_cast<float>(scale)](float disparity) {
    return static_cast<float>(floor_of(disparity * steps + 0.5f)) / disparity_steps;
  };
  if (scale == 1) {
    std::ranges::transform(from, to.begin(), in_steps);
    return;
  }
  auto at = to.begin();
  for (const float disparity : from) at = std::fill_n(at, scale, in_steps(disparity));
}

/// The disparities that a view is the first to see in a row, in pixels of the reference view. Columns that are left
/// over at the end repeat the column beside them.
void first_seen(const View& view, int row, std::span<float> to) {
  const auto from = view.disparity.row(row);
  if (view.wanted.empty()) {
    round_to_steps(from, 1, to);
    return;
  }
  // In views other than the reference, most pixels have been seen by earlier views.
  std::ranges::fill(to, std::numeric_limits<float>::quiet_NaN());
  const auto own = view.wanted.row(row);
  const auto scale = static_cast<std::size_t>(view.frame.scale);
  for (auto end = own.begin();;) {
    const auto begin = std::find_if(end, own.end(), [](std::uint8_t value) { return value != 0; });
    if (begin == own.end()) break;
    end = std::find(begin, own.end(), std::uint8_t{0});
    const auto first = static_cast<std::size_t>(begin - own.begin()), count = static_cast<std::size_t>(end - begin);
    round_to_steps(from.subspan(first, count), view.frame.scale, to.subspan(scale * first, scale * count));
  }
  std::ranges::fill(to.subspan(scale * from.size()), to[scale * from.size() - 1]);
}

/// The surface that a view is the first to see, in a picture of this size.
Surface surface_of(const View& view, int width, int height) {
  Surface surface{view.position, KnownRuns(width, height), view.frame.origin_px, view.continued};
  std::vector<float> seen(static_cast<std::size_t>(width));
  const int rows = view.disparity.height();
  for (int row = 0; row < rows; ++row) {
    first_seen(view, row, seen);
    const int first = row * view.frame.scale, end = row + 1 < rows ? first + view.frame.scale : height;
    for (int y = first; y < end; ++y) surface.disparity.add_row(seen);
  }
  return surface;
}

Surfaces surfaces_of(std::span<const View> views, const Style& style) {
  Surfaces surfaces{.seen = std::vector<Surface>(views.size())};
  const ImageView<const Rgb8> reference = views.front().colour;
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    surfaces.seen[i] = surface_of(views[i], reference.width(), reference.height());
  });
  surfaces.tolerance_px = ScaledStyle(style, reference.width()).depth_threshold_px;
  return surfaces;
}

PlannedFrame plan_from_views(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                             PaintingMemory& memory, const Progress& progress, StrokeFits* fits) {
  report(progress, "painting", 0);
  PlannedFrame planned;
  Painting& painting = planned.painting;
  switch (style.marks) {
    case Marks::strokes:
    case Marks::fitted_strokes: {
      CarriedPainting carried = plan_strokes(frame, style, options, memory.strokes, progress, fits);
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
  painting.surfaces = surfaces_of(frame.views, style);
  painting.relief = relief_for(style, width_of(painting));
  return planned;
}

}  // namespace

PlannedFrame plan_without_repair(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                                 PaintingMemory& memory, const Progress& progress, StrokeFits* fits) {
  check_style(style);
  check_fits(frame.views);
  if (is_of_strokes(style) && frame.flow == nullptr)
    return plan_from_views(frame, style, options, memory, progress, fits);
  // Only new strokes are planned from smaller pictures.
  const std::vector<View> scene = at_reference_scale(frame.views);
  return plan_from_views({scene, frame.flow}, style, options, memory, progress, fits);
}

namespace {

/// The finest painting with at most `style.strokes` strokes, or the coarsest there is. Where the picture is planned is
/// the same for all finenesses, so that the number of strokes grows with it.
PlannedFrame plan_within_budget(const FilmFrame& frame, Style style, const CarryOptions& options,
                                PaintingMemory& memory, const Progress& progress) {
  constexpr int halvings = 7;
  const auto most = static_cast<std::size_t>(std::exchange(style.strokes, 0));
  float coarse = 0, fine = 1;
  std::optional<PlannedFrame> best;
  PaintingMemory best_memory;
  for (int i = 0; i <= halvings; ++i) {
    style.fineness = i == 0 ? coarse : (coarse + fine) / 2;
    PaintingMemory own;
    PlannedFrame planned = plan_frame(frame, style, options, own, progress);
    const bool fits = count_marks(planned.painting).count <= most;
    (fits ? coarse : fine) = style.fineness;
    if (!fits && best) continue;
    best = std::move(planned);
    best_memory = std::move(own);
    if (!fits) break;
  }
  memory = std::move(best_memory);
  return std::move(*best);
}

}  // namespace

PlannedFrame plan_frame(const FilmFrame& frame, const Style& style, const CarryOptions& options, PaintingMemory& memory,
                        const Progress& progress, StrokeFits* fits) {
  check_style(style);
  if (style.strokes > 0) {
    if (options.goes_on)
      throw Error(ErrorKind::wrong_usage, "style: strokes is the number of a still's strokes, expected 0 for a film");
    return plan_within_budget(frame, style, options, memory, progress);
  }
  PlannedFrame planned = plan_without_repair(frame, style, options, memory, progress, fits);
  repair(frame.views, style, planned.painting);
  // Films for displays alone show views beside the eyes.
  if (options.goes_on && std::ranges::any_of(frame.views, &View::continued))
    cover_bare(frame.views, style, planned.painting);
  return planned;
}

}  // namespace wheatstone
