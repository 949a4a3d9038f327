#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/seen_surface_gpu_internal.h"
#include "wheatstone/gpu/views.h"

namespace wheatstone {

constexpr std::uint32_t packed(Rgb8 colour) {
  return colour.r | static_cast<std::uint32_t>(colour.g) << 8 | static_cast<std::uint32_t>(colour.b) << 16;
}

/// Views that one run draws.
struct ViewsOnGpu {
  std::vector<ViewPosition> positions;     ///< at most most_gpu_views
  std::vector<std::uint32_t> backgrounds;  ///< packed, view by view; empty: none
};

/// What the programs write of a pixel beside its colour.
constexpr std::uint32_t gpu_bare_pixel = std::uint32_t{2} << 24;

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
    float depth, depth_slope;  ///< disparity of its beginning, and the step to its end; of a rigid one: of a row
    float reach;
    std::uint32_t stroke;  ///< the highest bit: rigid
  };

  StrokesForGpu(const PreparedStrokes& painting, const PreparedSurfaces& surfaces);

  std::vector<Stroke> strokes;
  std::vector<Segment> segments;
  float still_depth = 0;  ///< the middle of all disparities
};

/// For every cell of a picture, the segments that views within a distance of the central view may see there: all of
/// them from the nearest stroke to the farthest, then once more those that fill gaps.
struct CellsForGpu {
  CellsForGpu(const StrokesForGpu& of, int width, int height, float farthest_view);

  std::int32_t
      first_cell;  ///< number of a band's first one: where still_depth lies, it may be moved out of the picture
  std::uint32_t cells_a_band = 0;
  std::vector<std::uint32_t> cell_first;  ///< where each cell's begin in `in_cells`, and where the last one's end
  std::vector<std::uint32_t> in_cells;    ///< the highest bit: fills gaps
};

/// Strokes on the graphics processor. Made and used within on_gpu(); what it was made of must stay.
class GpuStrokes {
 public:
  GpuStrokes(const PreparedStrokes& painting, const PreparedSurfaces& surfaces);
  /// The pixels of each view. `planes`: the surfaces as the views see them.
  GpuBuffer draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views);

 private:
  struct CellsOnGpu {
    float farthest_view;
    std::int32_t first_cell;
    std::uint32_t cells_a_band;
    GpuBuffer cell_first, in_cells;
  };

  /// Sorts the segments into cells, unless they are for all these views.
  void fill_cells(std::span<const ViewPosition> views);

  const PreparedStrokes& painting_;
  StrokesForGpu flat_;
  GpuProgram draw_strokes_, continue_paint_;
  GpuBuffer strokes_, segments_;
  std::optional<CellsOnGpu> cells_;
};

/// Regions on the graphics processor. Made and used within on_gpu(); what it was made of must stay.
class GpuRegions {
 public:
  GpuRegions(const RegionPainting& painting, const PreparedSurfaces& surfaces);
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
  GpuDiffusion(const DiffusionPainting& painting, const PreparedSurfaces& surfaces);
  GpuBuffer draw(const GpuSurfaces& surfaces, const GpuBuffer& planes, const ViewsOnGpu& views) const;

 private:
  /// What the lines say of each pixel: red, green, blue, 0..255, and how much of it is held at them, 0..1.
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

 private:
  struct Kept;
  const PreparedPainting::Contents& contents_;
  std::unique_ptr<Kept> kept_;
};

}  // namespace wheatstone
