#pragma once

#include <limits>
#include <string>
#include <vector>

#include "wheatstone/depth/rig.h"
#include "wheatstone/image/image.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/particles/cloud.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// How views are made from particles.
enum class Method {
  automatic,    ///< whichever should be the fastest (cost_model.h)
  exact,        ///< each view on its own (SVR)
  incremental,  ///< projected and lit once, moved for each view (IFA; Hassaine 2010, ch. 4)
  layered,      ///< cut into depth planes that are moved (MLR; ch. 5)
};

/// How depth planes are filled and read.
enum class SliceFilter {
  nearest,   ///< a splat goes to its nearest plane, and planes move by whole pixels
  linear,    ///< planes are interpolated between two pixels
  centroid,  ///< a splat between planes goes to both, by its distance, so that its middle is right in every view;
             ///< planes are interpolated by a cubic
};

struct RenderOptions {
  Method method = Method::automatic;
  SliceFilter filter = SliceFilter::linear;
  int planes = 0;       ///< depth planes; 0: one for each pixel of parallax
  bool opaque = false;  ///< the nearest particle hides the others, instead of adding its light to theirs
  float exposure = std::numeric_limits<float>::quiet_NaN();  ///< NaN: from the central view
};

/// The views, left to right, and how they were made.
struct RenderedViews {
  std::vector<Image<Rgb8>> views;
  Method method = Method::exact;
  std::string reason;  ///< why this method, for people
  int planes = 0;      ///< of the layered method
  float exposure = 1;
};

/// Renders every view of a rig. The cloud's positions are finite, its densities and temperatures above 0 (select.h).
/// The same bytes on any number of threads. Throws Error{wrong_usage} where the options make no sense.
RenderedViews render(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options = {},
                     const Progress& progress = {});

/// The factor that brings the brighter parts of the central view to where the tone map still tells them apart.
float automatic_exposure(const Cloud& cloud, const Scene& scene, const Rig& rig);

}  // namespace wheatstone
