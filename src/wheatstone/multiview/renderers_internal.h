#pragma once

#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/slice_band_internal.h"

namespace wheatstone {

/// The cloud, scene and rig of one rendering, and what all renderers derive from them alike.
struct RenderJob {
  const Cloud& cloud;
  const Scene& scene;
  const Rig& rig;
  const CloudStatistics& statistics;
  const ToneMap& tone;
};

/// Depth planes between the nearest and the farthest parallax of a mapping.
struct DepthPlanes {
  std::vector<float> parallaxes;  ///< ascending, evenly spaced
  float spacing_px = 1;
};

/// `count` of them; 0 for one at each pixel by which a point moves between two eyes, or between the outermost views
/// where those are farther apart.
DepthPlanes planes_of(const DepthMapping& mapping, int count, float span = 1);

SplatOrder order_by_plane(const Rig& rig, const SplatStyle& splat_style, const DepthPlanes& planes, SliceFilter filter);
Resampling resampling_of(SliceFilter filter);

/// The enlarged frustum: whatever any view of the rig sees (Hassaine 2010, sec. 4.3.1), in whole pixels.
Window window_around(const Scene& scene, const Rig& rig);

/// Fills the depth planes of a band one after the other, nearest first.
class PlaneFiller {
 public:
  PlaneFiller(const Window& window, const SplatOrder& order);
  void begin_band();
  /// The light of one plane, which the caller darkens when it has taken it. Planes are asked for in order, every one.
  LightBand& fill(const std::vector<SplatBlock>& blocks, int b, int plane);

 private:
  SplatOrder order_;
  LightBand plane_, next_;
};

SplatOrder bands_of(const Rig& rig, const SplatStyle& splat_style);

/// Eye separations between the outermost views.
float span_of(const Rig& rig);

/// The factor for pixels whose brightest channels are these.
float exposure_for(std::vector<float> brightest);

/// How far beyond the sides of the central view the outermost views look, in pixels.
float look_around_px(const Scene& scene, const Rig& rig);

void render_exact(const RenderJob& job, ViewPosition view, ImageView<Rgb8> picture);
void render_incremental(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures);
/// The nearest particle of each pixel, in each of the views.
void render_opaque(const RenderJob& job, std::span<const ViewPosition> views,
                   std::span<const ImageView<Rgb8>> pictures);
void render_layered(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter,
                    std::span<const ImageView<Rgb8>> pictures);

/// The light of a view, band by band.
std::vector<LightBand> light_of_view(const Cloud& cloud, const Scene& scene, const Rig& rig,
                                     const CloudStatistics& statistics, ViewPosition view);

}  // namespace wheatstone
