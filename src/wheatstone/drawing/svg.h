#pragma once

#include <string>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// How far a stroke's outline in an SVG document may be from the stroke's own, before it is rounded to tenths.
inline constexpr float svg_tolerance_px = 0.1f;

/// Whether a picture beneath a painting's marks shows the area between them.
bool svg_has_ground(const Painting& painting);

/// A painting as one view sees it, as an SVG document, in tenths of a pixel.
///
/// Strokes lie over the canvas colour. Every stroke is a path with round ends of as few Bézier curves as stay within
/// `svg_tolerance_px` of its B-spline; the brush's soft rim becomes a hard edge at half cover. A surface cuts it where
/// it hides the middle of the brush. Invisible strokes are left out. A colour that changes along a stroke is a linear
/// gradient from its first to its last point; what bristles leave is left out.
///
/// Regions lie far to near: every mark is a path, its holes left out. Seams between neighbours are closed by a thin
/// line of the mark's colour.
///
/// Lines beside edges are paths, each in pieces of about one colour. SVG cannot spread colours between them:
/// `ground_png`, the view as it is drawn, is embedded and lies beneath; empty: there is no ground.
std::string svg_of(const Painting& painting, ViewPosition view, const std::string& ground_png = {});

}  // namespace wheatstone
