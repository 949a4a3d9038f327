#pragma once

#include <memory>
#include <span>
#include <string>
#include <utility>
#include <variant>

#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/drawing/prepared_lines_internal.h"
#include "wheatstone/drawing/prepared_strokes_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"

namespace wheatstone {

class PaintingOnGpu;

struct PreparedPainting::Contents {
  int width, height;
  std::variant<PreparedStrokes, RegionPainting, PreparedLines> marks;
  Surfaces surfaces;
  Relief relief;
  std::shared_ptr<PaintingOnGpu> on_gpu = {};  ///< empty where the processor draws
  Device device = Device::processor;           ///< that was asked for
  bool deep = false;                           ///< as in DrawOptions
};

// How each kind of marks is made ready and drawn.

PreparedStrokes prepare_marks(const StrokePainting& painting);
inline RegionPainting prepare_marks(RegionPainting painting) { return painting; }
/// The overhangs of lines are set later, from the surfaces.
inline PreparedLines prepare_marks(DiffusionPainting painting) { return {std::move(painting), {}}; }

/// A view that is to be drawn.
struct ViewToDraw {
  ViewPosition position;
  ImageView<const Rgb8> background;  ///< may be empty
  DrawnView& drawn;
};

/// Also draws DrawnView::deep, where that is not empty.
void draw_marks(const PreparedStrokes& painting, const Surfaces& surfaces, std::span<const ViewToDraw> views);
/// Draws some bands of views that have their pictures; with `only_under_top`, only where strokes of the last layer may
/// lie.
void draw_bands(const PreparedStrokes& painting, const Surfaces& surfaces, std::span<const ViewToDraw> views,
                std::span<const int> bands, bool only_under_top = false);
/// Adds a layer of strokes with the brush of the last one, and draws its bands again.
void draw_marks_over(PreparedStrokes& painting, const Surfaces& surfaces, const Layer& strokes, const ViewToDraw& view);
void draw_marks(const RegionPainting& painting, const Surfaces& surfaces, std::span<const ViewToDraw> views);
void draw_marks(const PreparedLines& lines, const Surfaces& surfaces, std::span<const ViewToDraw> views);

// The same as SVG (svg.h). Marks with a ground need a picture of the view beneath them.

std::string svg_of_marks(const StrokePainting& painting, ViewPosition view, const Hiding& hiding,
                         const std::string& ground_png);
std::string svg_of_marks(const RegionPainting& painting, ViewPosition view, const Hiding& hiding,
                         const std::string& ground_png);
std::string svg_of_marks(const DiffusionPainting& painting, ViewPosition view, const Hiding& hiding,
                         const std::string& ground_png);
inline bool svg_marks_have_ground(const StrokePainting& /*painting*/) { return false; }
inline bool svg_marks_have_ground(const RegionPainting& /*painting*/) { return false; }
inline bool svg_marks_have_ground(const DiffusionPainting& /*painting*/) { return true; }

}  // namespace wheatstone
