#pragma once

#include <cstddef>
#include <span>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/plan_painting.h"

namespace wheatstone {

/// As plan_frame, but without the marks of `repair`.
PlannedFrame plan_without_repair(const FilmFrame& frame, const Style& style, const CarryOptions& options,
                                 PaintingMemory& memory, const Progress& progress = {}, StrokeFits* fits = nullptr);

/// Adds small marks where a photographed view would show a colour that its photograph has nowhere near
/// (marks/residual.h). Paintings of regions and of lines are drawn and compared: small things may have been joined to
/// large ones, colours may be missing, and a difference may have no edge (with a central reference view, lines are
/// compared in that view only). Strokes and lines are repaired in other views than the reference, too, where its
/// colours contradict the view's because a disparity is wrong. Faults in the reference view are repaired for all views,
/// faults in another view for the views around it. Paintings of tiles, those whose colours are changed at random, and
/// those of eyes apart are left as they are. The painting has its surfaces.
void repair(std::span<const View> views, const Style& style, Painting& painting);

/// Covers what strokes leave bare in the reference view, in those beside the eyes and between them, with marks that are
/// not carried on: in a film, surfaces that turn into sight have faint strokes, and edges beside the reference view
/// have none.
void cover_bare(std::span<const View> views, const Style& style, Painting& painting);

/// True for paintings of strokes that are repaired once they are drawn: what is wrong is then known, whatever made it.
/// Not for those whose colours are changed at random, or whose paint is lit, those of eyes apart, and narrow ones.
bool is_repaired_when_drawn(const Painting& painting, const Style& style);

/// A view of a scene, drawn.
struct ShownView {
  const View& view;
  ImageView<const Rgb8> background;
  DrawnView drawn;
};

/// Adds strokes where pictures that were drawn show such colours, to the painting and to what was prepared of it, and
/// draws them over the pictures. `reference` is the position of the scene's reference view.
void repair_drawn(std::span<ShownView> shown, ViewPosition reference, const Style& style, Painting& painting,
                  PreparedPainting& prepared);

}  // namespace wheatstone
