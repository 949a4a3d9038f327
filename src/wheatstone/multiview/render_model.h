#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "wheatstone/depth/rig.h"
#include "wheatstone/models/model.h"
#include "wheatstone/multiview/model_scene.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/progress.h"

namespace wheatstone {

struct RenderModelOptions {
  /// `exact`: each view is projected, clipped and lit on its own. `incremental`: that is done once, and triangles are
  /// moved for each view; the same bytes. `automatic` is incremental.
  Method method = Method::automatic;
  bool geometry = false;  ///< disparity and depth, too
};

/// The views, left to right.
struct RenderedModel {
  std::vector<Image<Rgb8>> views;
  /// Disparity and depth of each view, if they were asked for: those of the surface that takes up most of a pixel, at
  /// the middle of its samples there. Disparity is that from the screen plane, −parallax, in pixels of a view at full
  /// eye separation; depth is in scene units. NaN where there is no surface.
  std::vector<Image<float>> disparity, depth;
  Method method = Method::incremental;
  std::string reason;                 ///< why this method, for people
  std::uint64_t drawn_triangles = 0;  ///< of the model, or their parts, that lie in one view at least
};

/// Renders every view of a rig. A point of disparity d that the central view has at x, the view at v has at x − v·d.
/// Corners of triangles are rounded to 1/256 px in the central view, and so is their disparity, so that both methods
/// draw the same triangles. A smooth depth mapping is replaced by lines that are off by less than 1/16 px. The same
/// bytes on any number of threads. Throws Error{wrong_usage} where the options make no sense.
RenderedModel render_model(const Model& model, const ModelScene& scene, const Rig& rig,
                           const RenderModelOptions& options = {}, const Progress& progress = {});

}  // namespace wheatstone
