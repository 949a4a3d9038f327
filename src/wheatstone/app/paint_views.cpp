#include "wheatstone/app/paint_views.h"

#include "wheatstone/error.h"

namespace wheatstone {

PaintedViews paint_views(const StereoPair& photographs, const PaintPhotographOptions& painting,
                         DisplayViewsOptions views, const Progress& progress,
                         const std::optional<DisplayComposition>& composition) {
  check_style(painting.style);
  if (painting.style.propagation != Propagation::strokes)
    throw Error(ErrorKind::wrong_usage,
                "views beside the two eyes need strokes that are propagated, expected propagation 'strokes'");
  const FoundGeometry found = find_geometry(photographs, painting, progress);
  if (painting.zero_parallax.disparity_px || painting.zero_parallax.at)
    views.zero_parallax_px = screen_disparity(painting.zero_parallax, found.geometry);
  const Painting planned = plan_painting(photographs, found.geometry, painting.style, progress);
  return {draw_display_views(planned, views, progress, composition), found.confidence};
}

}  // namespace wheatstone
