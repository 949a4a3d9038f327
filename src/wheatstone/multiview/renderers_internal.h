#pragma once

#include "wheatstone/multiview/chunks.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/slice_band_internal.h"

namespace wheatstone {

/// The cloud, scene and rig of one rendering, and what all renderers derive from them alike.
struct RenderJob {
  const Chunks& chunks;
  const Scene& scene;
  const Rig& rig;
  const CloudStatistics& statistics;
  const ToneMap& tone;
  std::optional<Focus> focus = {};  ///< of the layered method
  Ranks ranks = {};                 ///< the chunks come to them in step
};

/// The same job of other chunks, which must stay.
inline RenderJob of_chunks(const RenderJob& job, const Chunks& chunks) {
  return {chunks, job.scene, job.rig, job.statistics, job.tone, job.focus, job.ranks};
}

/// Depth planes between the nearest and the farthest parallax of a mapping.
struct DepthPlanes {
  std::vector<float> parallaxes;  ///< ascending, evenly spaced
  float spacing_px = 1;
};

/// Makes `count` planes. 0: one plane per pixel of parallax range between two eyes, or between the outermost views if
/// these are farther apart.
DepthPlanes planes_of(const DepthMapping& mapping, int count, float span = 1);

/// The enlarged frustum: whatever any view of the rig sees (Hassaine 2010, sec. 4.3.1), in whole pixels, where depth is
/// multiplied by up to `gain`.
Window window_around(const Scene& scene, const Rig& rig, float gain = 1);

/// The columns of the depth planes that any view sees.
Window window_of_planes(const RenderJob& job);

/// A view's focus in the pixels of one of its pictures.
std::optional<Focus> focus_in(const std::optional<Focus>& focus, const SplatOrder& order);

class GatheredLight;

/// A plane of a band.
struct BandPlane {
  int band, plane;
};

/// Adds the splats of one block in one plane to `here`, the plane's light, and their share in the next plane to `next`.
void deposit_plane(const SplatBlock& block, const SplatOrder& order, Deposit kind, BandPlane at, LightBand& here,
                   LightBand& next);

/// Adds splats to the light of all planes of all pictures.
void deposit_in_planes(const std::vector<SplatBlock>& blocks, const SplatOrders& orders, Deposit kind,
                       GatheredLight& light);

/// Fills the depth planes of a band one after the other, nearest first.
class PlaneFiller {
 public:
  PlaneFiller(const Window& window, const SplatOrder& order, Deposit kind);
  void begin_band();
  /// The light of one plane; the caller darkens it after use. Every plane must be asked for, in ascending order.
  LightBand& fill(const std::vector<SplatBlock>& blocks, int b, int plane);

 private:
  SplatOrder order_;
  Deposit kind_;
  LightBand plane_, next_;
};

/// Eye separations between the outermost views.
float span_of(const Rig& rig);

/// How far beyond the sides of the central view the outermost views look, in pixels.
float look_around_px(const Scene& scene, const Rig& rig);

/// Each of the views on its own.
void render_exact(const RenderJob& job, std::span<const ViewPosition> views, std::span<const ImageView<Rgb8>> pictures);
void render_incremental(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures);
/// The nearest particle of each pixel, in each of the views.
void render_opaque(const RenderJob& job, std::span<const ViewPosition> views,
                   std::span<const ImageView<Rgb8>> pictures);
/// Particles that absorb as they shine (Blend::over), in each of the views, one target each.
void render_front_to_back(const RenderJob& job, std::span<const ViewPosition> views,
                          std::span<const ViewTarget> targets);
/// If `pictures` is empty, the planes are filled but not composited.
void render_layered(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter,
                    std::span<const ImageView<Rgb8>> pictures);

/// On a graphics processor, in fixed point (splat_kinds.glsl): sums are of 64 bits, with steps of 2^−28 of a mean
/// particle's light, up to 2^35 of it. A splat's light is counted in such steps, or in steps of 2^−16 of itself if
/// these are larger. For mass, the remainder is counted, too, in steps of the sums, if the light is at most 2^12. Throw
/// Error{wrong_usage} where there is no graphics processor.
void render_incremental_on_gpu(const RenderJob& job, bool opaque, std::span<const ImageView<Rgb8>> pictures);
void render_layered_on_gpu(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter,
                           std::span<const ImageView<Rgb8>> pictures);

/// The light of a view, of the size of the rig's.
ViewLight light_of_view(const RenderJob& job, ViewPosition view);

/// The settings that the options ask for, with what the scene's particles decide.
ToneSettings tone_for(const Scene& scene, const RenderOptions& options);

/// The settings with what they leave open found from a small picture of some of the particles: the exposure of the
/// thesis's look, or the limits between which mass is shown.
ToneSettings settled(const ToneSettings& settings, const Scene& scene, const CloudStatistics& statistics,
                     const Rig& rig);

}  // namespace wheatstone
