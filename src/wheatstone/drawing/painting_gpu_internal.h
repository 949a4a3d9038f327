#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/drawing/draw_gpu.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/seen_surface_gpu_internal.h"
#include "wheatstone/gpu/views.h"

namespace wheatstone {

/// Views that one run draws.
struct ViewsOnGpu {
  std::vector<ViewPosition> positions;     ///< at most most_gpu_views
  std::vector<std::uint32_t> backgrounds;  ///< packed, view by view; empty: none
  /// Where only some pixels are wanted, a bit each, rows of whole words: others may be left undrawn.
  std::optional<GpuBuffer> wanted = {};
};

/// Flag that the programs set in a pixel, beside its colour.
constexpr std::uint32_t gpu_bare_pixel = std::uint32_t{2} << 24;

/// The number of a view's pixels with each flag.
struct FlagCounts {
  std::uint32_t gaps, bare, wanted;
};

/// Strokes as draw_strokes.comp reads them, the nearest first.
struct StrokesForGpu {
  struct Stroke {
    float red, green, blue, opacity;
    float middle_px, rim_px;
    float first_view, last_view;
    std::int32_t planned_in;
  };
  struct Segment {
    float x, y, dx, dy;
    float depth, depth_slope;  ///< disparity at its beginning, and its change to the end; of a rigid stroke: at row 0,
                               ///< and its change a row
    float reach;
    std::uint32_t stroke;  ///< the highest bit: rigid
  };
  /// What varies within a stroke, as bristles.glsl reads it: two texels.
  struct Bristles {
    float red_change, green_change, blue_change, length;
    /// Of the stroke and of a bristle; a width below 0: its absolute value, and the brush has a picture.
    float radius_px, width_px;
    float dry_px;  ///< length before a stroke's end in which bristles may run out of paint; 0: none does
    std::uint32_t seed;
  };
  /// A segment's places along its stroke, in pixels: a texel.
  struct PlacesOfSegment {
    float begin, length;
    float least, most;  ///< shares of its length between which it has places
  };

  StrokesForGpu(const PreparedStrokes& painting, const Surfaces& surfaces);

  std::vector<Stroke> strokes;
  std::vector<Segment> segments;
  // Empty unless the paint varies within strokes.
  std::vector<Bristles> bristles;
  std::vector<PlacesOfSegment> places;
  float still_depth = 0;  ///< the middle of all disparities
};

/// Calls `use` with each stroke's layer and its place there, from the nearest stroke to the farthest.
template <class Use>
void for_strokes_from_nearest(const PreparedStrokes& painting, Use use) {
  for (std::size_t layer = painting.layers.size(); layer-- > 0;)
    for (std::size_t place = painting.layers[layer].flat.strokes.size(); place-- > 0;)
      use(painting.layers[layer], place);
}

/// Calls `use` with the vertices at both ends of each segment of a stroke. A dot has one segment, of length 0.
template <class Use>
void for_segments(const FlatStroke& stroke, Use use) {
  const std::uint32_t last = stroke.first_vertex + stroke.vertex_count - 1;
  for (std::uint32_t from = stroke.first_vertex; from < std::max(last, stroke.first_vertex + 1); ++from)
    use(from, std::min(from + 1, last));
}

/// For every cell of a picture, the segments that views within a distance of the central view may see there: all of
/// them from the nearest stroke to the farthest, then once more those that fill gaps.
struct CellsForGpu {
  CellsForGpu(const StrokesForGpu& of, int width, int height, float farthest_view, int tile_columns);

  std::int32_t
      first_cell;  ///< number of a band's first one: where still_depth lies, it may be moved out of the picture
  std::uint32_t cells_a_band = 0;
  std::vector<std::uint32_t> cell_first;  ///< where each cell's begin in `in_cells`, and where the last one's end
  std::vector<std::uint32_t> in_cells;    ///< the highest bit: fills gaps
};

/// These cells for views within a distance of the central view, on the graphics processor.
struct CellsOnGpu {
  int tile_columns;
  float farthest_view, still_depth;
  std::int32_t first_cell;
  std::uint32_t cells_a_band;
  GpuBuffer cell_first, in_cells;
};

/// The relief of strokes on the graphics processor. Made and used within on_gpu().
class GpuRelief {
 public:
  GpuRelief(const PreparedStrokes& painting, const Surfaces& surfaces, const Relief& relief);
  /// Lights the pixels of these views. `cells` are those of the strokes, for all of the views.
  void light(const GpuSurfaces& surfaces, const GpuBuffer& planes, std::span<const ViewPosition> views,
             const CellsOnGpu& cells, const GpuBuffer& pixels) const;

 private:
  int width_, height_;
  Relief relief_;
  GpuProgram relief_strokes_, light_relief_;
  std::optional<GpuBuffer> strokes_, segments_;
};

/// Strokes on the graphics processor. Made and used within on_gpu(); what it was made of must stay.
class GpuStrokes {
 public:
  GpuStrokes(const PreparedStrokes& painting, const Surfaces& surfaces, const Relief& relief);
  /// The pixels of each view. `planes`: the surfaces as the views see them.
  GpuBuffer draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views);

 private:
  /// Sorts the segments into cells, unless the present cells are for all these views and for tiles of this width.
  void fill_cells(std::span<const ViewPosition> views, int tile_columns);

  const PreparedStrokes& painting_;
  StrokesForGpu flat_;
  GpuProgram draw_strokes_, continue_paint_, want_rows_;
  GpuBuffer strokes_, segments_, bristles_, places_, brush_picture_;
  std::optional<CellsOnGpu> cells_;
  std::optional<GpuRelief> relief_;
};

/// Regions on the graphics processor. Made and used within on_gpu(); what it was made of must stay.
class GpuRegions {
 public:
  GpuRegions(const RegionPainting& painting, const Surfaces& surfaces);
  GpuBuffer draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const;

 private:
  struct Buffers {
    GpuBuffer marks, band_first, in_bands, edges;
  };

  const RegionPainting& painting_;
  GpuProgram sample_regions_, finish_regions_;
  std::optional<Buffers> buffers_;
};

/// Lines of colour on the graphics processor. Made and used within on_gpu(); what it was made of must stay.
class GpuDiffusion {
 public:
  GpuDiffusion(const PreparedLines& lines, const Surfaces& surfaces);
  GpuBuffer draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const;

 private:
  /// The colour that the lines give to each pixel: red, green, blue, 0..255, and its weight, 0..1.
  GpuBuffer lines(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const;

  const DiffusionPainting& painting_;
  ViewRange photographed_;
  GpuProgram add_lines_, know_lines_, halve_known_, fill_known_, settle_colours_, finish_diffusion_;
  std::size_t piece_count_ = 0;
  std::optional<GpuBuffer> pieces_;
};

/// A painting that the graphics processor keeps.
class PaintingOnGpu {
 public:
  /// `contents` must stay. Throws Error{wrong_usage} where there is no graphics processor, or it fails.
  explicit PaintingOnGpu(const PreparedPainting::Contents& contents);
  PaintingOnGpu(const PaintingOnGpu&) = delete;
  PaintingOnGpu& operator=(const PaintingOnGpu&) = delete;
  ~PaintingOnGpu();

  /// Throws the same.
  void draw(std::span<const ViewToDraw> views);
  /// As draw_on_gpu() does; nothing where not enough views fit at once.
  std::optional<double> draw(std::span<const ViewPosition> views,
                             const std::function<GpuViewSink(const GpuFacts&)>& make_sink);

 private:
  struct Kept;
  std::size_t views_at_once(const GpuFacts& facts) const;
  GpuBuffer drawn(const ViewsOnGpu& views);
  std::vector<FlagCounts> flags_of(const GpuBuffer& pixels, std::size_t views) const;

  const PreparedPainting::Contents& contents_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace wheatstone
