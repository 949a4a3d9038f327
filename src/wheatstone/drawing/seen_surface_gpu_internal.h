#pragma once

#include <span>

#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/program.h"

namespace wheatstone {

/// A painting's surfaces on the graphics processor. Made and used within on_gpu().
class GpuSurfaces {
 public:
  /// Disparity where no surface is known: farther than anything.
  static constexpr float unknown = -1e30f;
  static constexpr std::size_t planes_a_view = 3;  ///< the reference view's, what photographs show, the nearest

  explicit GpuSurfaces(const Surfaces& surfaces);

  bool empty() const { return parts_ == 0; }
  float tolerance_px() const { return tolerance_px_; }
  /// The planes of each view, row by row; one word where there are no surfaces.
  GpuBuffer seen(std::span<const ViewPosition> views, int width, int height) const;

 private:
  GpuSurfaces(const Surfaces& surfaces, const struct FlatSurfaces& flat);

  int parts_;
  float tolerance_px_;
  GpuProgram see_surfaces_;
  GpuBuffer of_parts_, first_runs_, runs_, disparities_;
};

}  // namespace wheatstone
