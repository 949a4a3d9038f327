#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/strokes/fit_stroke_internal.h"
#include "wheatstone/strokes/strokes_in_time.h"

namespace wheatstone {

inline constexpr int fit_waves = 4;   ///< in which the blocks of a layer are planned
inline constexpr int fit_passes = 2;  ///< over a block's cells, the second shifted by half a cell

/// What became of a cell: no stroke may gain in it as its pass begins; or it was left out later; or a stroke was fitted
/// from the pixel `anchor` of its tile and gained too little, or was painted.
struct CellOutcome {
  enum class Kind : std::uint8_t { no_gain, left_out, in_vain, painted };
  Kind kind = Kind::no_gain;
  std::uint32_t place = 0;  ///< in_vain: the tile's pixel; painted: the stroke's number in its block
};

/// A stroke that was painted.
struct PaintedStroke {
  FittedStroke stroke;       ///< in pixels of its block's tile
  std::uint64_t random = 0;  ///< of its cell
  std::uint32_t number = 0;  ///< of its cell, from 1 to fitted_places
};

/// How a block was planned: the outcome of each cell of each pass, row by row, and the strokes in the order in which
/// they were painted. No cells: it was not worth a look.
struct BlockOutcome {
  std::array<std::vector<CellOutcome>, fit_passes> cells;
  std::vector<PaintedStroke> strokes;
};

/// By row: not 0 where something differs from the last time.
using DifferingRows = std::vector<std::uint8_t>;

/// What drawing a layer leaves behind, so that it is drawn again only in bands of rows in which something differs.
/// Canvases are absent while they are planned on, and where nothing is known.
struct LayerDrawing {
  std::optional<Canvas> begun;    ///< as the layer began, where it is larger than that of the layer before
  std::optional<Canvas> painted;  ///< with the layer's strokes
  Layer strokes;                  ///< these, in the layer's pixels; their numbers ascend
  /// Where the canvas on which the layer begins may differ from that on which it was fitted, and, once it has been
  /// fitted again, where anything differed that its strokes or how they are hidden depend on. Empty: not known.
  DifferingRows differs;
};

/// What fitting a layer leaves behind, so that less has to be fitted when some of its picture has changed. About 90
/// bytes a pixel of the layer.
struct LayerFit {
  // What must not differ.
  Style style;
  float radius_px = 0, least_gain = 0, depth_threshold_px = 0;
  // What may, and is compared.
  Image<Rgb8> colour;  ///< that the reference was made from
  std::shared_ptr<const ReferencePicture> reference;
  Image<std::uint8_t> seeds, detail, outlines;
  Image<float> disparity;
  /// The canvas as each wave began.
  std::array<PaintedPicture, fit_waves> canvases;
  PaintedPicture canvas;  ///< on which the layer is planned; holds something only where that is needed
  std::vector<BlockOutcome> blocks;
  LayerDrawing drawing;

  /// Whether the reference was made from these.
  bool is_made_from(ImageView<const Rgb8> now, float radius_now_px, const Style& style_now) const;
};

/// What planning a view leaves behind.
struct ViewFit {
  View view;  ///< as it was; owns its images
  Style style;
  ViewsBeside beside;
  int reference_width = 0;
  std::vector<LayerFit> layers;
  std::vector<TrackedLayer> planned;

  /// Whether planning would give the same.
  bool holds(const View& now, const Style& style_now, const ViewsBeside& beside_now, int reference_width_now) const;
};

/// A layer that is fitted again: which pixels differ from the last time, in what is wanted of them or in what is
/// painted on them. Blocks of one wave may use it at once.
class Refit {
 public:
  /// Compares with the last time, and takes over what is there now. Everything differs where nothing is known.
  Refit(const LayerPlan& plan, std::size_t blocks, LayerFit& before);

  /// The canvas as the coarser layers left it.
  const PaintedPicture& begun() const { return before_.canvases.front(); }
  /// The canvas on which the layer is planned: as it was begun, at the pixels that differ.
  PaintedPicture& canvas() { return before_.canvas; }

  bool differs(const PixelArea& area) const;
  void mark(const PixelArea& area);
  /// Paints the pixels that do not differ as they were when the wave began.
  void restore(int wave, const PixelArea& area, PaintedPicture& canvas) const;
  BlockOutcome& block(std::size_t index) { return before_.blocks[index]; }
  /// Whether the block was worth a look the last time.
  bool was_worth(std::size_t index) const { return !before_.blocks[index].cells.front().empty(); }
  void end_wave(int wave);
  /// Marks the rows of LayerDrawing in which anything differs.
  void mark_rows();

 private:
  void compare_row(const LayerPlan& plan, int y);

  LayerFit& before_;
  Image<std::uint8_t> differs_;
};

/// As enlarged_canvas, for the layer that begins on it.
Canvas enlarge_again(const BegunCanvas& begun, LayerDrawing& drawing);

/// Draws a layer's strokes, whose numbers ascend, on the canvas on which it began, to `drawing.painted`, and marks
/// where that differs.
void draw_again(const Layer& strokes, const Canvas& begun, ViewPosition view, const Hiding& hiding, const Brush& brush,
                LayerDrawing& drawing);

/// Tells the next layer, whose canvas is `factor` times larger and has so many rows, where its canvas differs.
void pass_on(const DifferingRows& differs, int factor, int height, DifferingRows& next);

}  // namespace wheatstone
