#pragma once

#include <filesystem>
#include <string>

#include "wheatstone/marks/painting.h"

namespace wheatstone {

/// A painting as one view sees it, as an SVG document over the canvas colour: every stroke a path with round ends, its
/// B-spline written as the Bézier curves that are equal to it. The brush's soft rim becomes a hard edge at half cover.
std::string svg_of(const StrokePainting& painting, ViewPosition view);

/// Regions as one view sees them, far to near: every mark a path, its holes left out. Seams between neighbours are
/// closed by a thin line of the mark's colour.
std::string svg_of(const RegionPainting& painting, ViewPosition view);

/// The lines beside the edges as one view sees them, each in its mean colour: SVG cannot spread colours between them.
std::string svg_of(const DiffusionPainting& painting, ViewPosition view);

/// As its kind of marks.
std::string svg_of(const Painting& painting, ViewPosition view);

/// Throws Error{cannot_read_write}.
void write_svg(const std::filesystem::path& path, const Painting& painting, ViewPosition view);

}  // namespace wheatstone
