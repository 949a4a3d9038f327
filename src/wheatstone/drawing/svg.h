#pragma once

#include <string>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// How far a stroke's outline in an SVG document may be from the stroke's own, before it is rounded to tenths.
inline constexpr float svg_tolerance_px = 0.1f;

/// A painting as one view sees it, as an SVG document over the canvas colour, in tenths of a pixel. Every stroke is a
/// path with round ends of as few Bézier curves as stay within `svg_tolerance_px` of its B-spline; the brush's soft rim
/// becomes a hard edge at half cover. Strokes that nearer ones hide wholly are left out.
std::string svg_of(const StrokePainting& painting, ViewPosition view);

/// Regions as one view sees them, far to near: every mark a path, its holes left out. Seams between neighbours are
/// closed by a thin line of the mark's colour.
std::string svg_of(const RegionPainting& painting, ViewPosition view);

/// The lines beside the edges as one view sees them, each in pieces of about one colour. SVG cannot spread colours
/// between them: `ground_png`, the view as it is drawn, is embedded and lies beneath the lines; empty: no ground.
std::string svg_of(const DiffusionPainting& painting, ViewPosition view, const std::string& ground_png = {});

}  // namespace wheatstone
