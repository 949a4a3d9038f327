#pragma once

#include <optional>
#include <vector>

#include "wheatstone/curves/diffusion_in_time.h"
#include "wheatstone/image/orientation_field.h"
#include "wheatstone/marks/spline.h"

namespace wheatstone {

/// A place on a surface, as one of the scene's views sees it.
struct SurfacePoint {
  PlanePoint at;
  float disparity = 0;
  std::uint32_t view = 0;  ///< which of the scene's
};

/// An edge of the frame before that a new one goes on.
struct EdgeBefore {
  float shift_px = 0;  ///< from the new edge to the old, carried here, across the edge
  SampledColour colours[2];
  float disparities[2] = {0, 0};
};

/// The edges of the frame before, as they are looked for from this one. Borrows all that it is made of.
class CarriedEdges {
 public:
  /// `views` are of this frame; `disparity` is that of its reference view, the first of them.
  CarriedEdges(const DiffusionMemory& before, const FlowPair& flow, std::span<const View> views,
               ImageView<const float> disparity, float depth_threshold_px);

  /// Which pixels of the reference view were edges, or lay beside one.
  Image<std::uint8_t> known_edges() const;

  /// The nearest edge of the same direction about a place; `carrier` is a point near by whose surface the edge moves
  /// with. Sides are as `across` has them.
  std::optional<EdgeBefore> find(PlanePoint at, Direction across, const SurfacePoint& carrier) const;

 private:
  std::optional<PlanePoint> before(PlanePoint at) const;
  std::optional<PlanePoint> before(const SurfacePoint& point) const;

  const DiffusionMemory& memory_;
  const FlowPair& flow_;
  std::span<const View> views_;
  ImageView<const float> disparity_;
  float depth_threshold_px_;
  std::vector<Image<std::uint32_t>> point_at_;  ///< in each view: 1 + index of a point in the pixel, 0 where none is
};

}  // namespace wheatstone
