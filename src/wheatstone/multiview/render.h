#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/depth/rig.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/image/image.h"
#include "wheatstone/multiview/chunks.h"
#include "wheatstone/multiview/focus.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/multiview/tone.h"
#include "wheatstone/particles/cloud.h"
#include "wheatstone/progress.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// How views are made from particles.
enum class Method {
  automatic,    ///< whichever should be the fastest (cost_model.h)
  exact,        ///< each view on its own (SVR)
  incremental,  ///< projected and lit once, moved for each view (IFA; Hassaine 2010, ch. 4)
  layered,      ///< cut into depth planes that are moved (MLR; ch. 5)
};

/// The name of a method in options and reports.
constexpr std::string_view name_of(Method method) {
  constexpr std::array<std::string_view, 4> names{"auto", "exact", "incremental", "layered"};
  return names[static_cast<std::size_t>(method)];
}

struct RenderOptions {
  Method method = Method::automatic;
  SliceFilter filter = SliceFilter::linear;
  int planes = 0;  ///< depth planes; 0: one for each pixel of parallax
  /// A graphics processor renders by the incremental or the layered method, and only particles that do not absorb.
  Device device = Device::processor;
  std::optional<Focus> focus;  ///< of the layered method, which auto then chooses: where the depth differs
  bool opaque = false;         ///< the nearest particle hides the others, instead of adding its light to theirs
  /// The exposure of the thesis's look; NaN: found from some of the particles, as are limits that `tone` leaves open.
  float exposure = std::numeric_limits<float>::quiet_NaN();
  ToneSettings tone;  ///< of mass; the look is the scene's
  /// The ranks that share the work. All call the same functions with the same options; the result is whole at the first
  /// rank only.
  Ranks ranks;
};

/// The views, left to right, and how they were made.
struct RenderedViews {
  std::vector<Image<Rgb8>> views;
  Method method = Method::exact;
  std::string reason;  ///< why this method, for people
  std::string device;  ///< "cpu", or the name of the graphics processor
  int planes = 0;      ///< of the layered method
  float exposure = 1;  ///< of the thesis's look
  ToneSettings tone;   ///< with all that was found
};

/// Renders every view of a rig. The cloud's positions are finite, its densities and temperatures above 0 (select.h).
/// The same bytes on any number of threads. Throws Error{wrong_usage} where the options make no sense.
RenderedViews render(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options = {},
                     const Progress& progress = {});

/// The same for particles that come in chunks and have these statistics. Only the light of the views or of the depth
/// planes is kept in memory, or the splats if they take less.
RenderedViews render(const Chunks& chunks, const CloudStatistics& statistics, const Scene& scene, const Rig& rig,
                     const RenderOptions& options = {}, const Progress& progress = {});

/// A view as numbers.
struct ViewValues {
  /// Mass per area of the scene if the camera is orthographic; in perspective, per area at the depth that the camera
  /// looks at.
  Image<float> column;
  Image<float> mean;  ///< of the quantity, weighted by mass; NaN where there is no mass; empty without a quantity
};

/// The views of a rig as numbers, of particles that are shown as mass, each on its own, in full precision.
std::vector<ViewValues> view_values(const Chunks& chunks, const CloudStatistics& statistics, const Scene& scene,
                                    const Rig& rig, const Ranks& ranks = {});

/// The tone that render() would find for this scene, from a small picture of some of the particles.
ToneSettings tone_found(const CloudStatistics& statistics, const Scene& scene, const Rig& rig,
                        const RenderOptions& options);

/// Mass per area of the scene that a unit of light stands for.
float column_of_light(const Scene& scene);

/// The factor that brings the brighter parts of the central view to where the thesis's tone map still tells them apart.
float automatic_exposure(const Cloud& cloud, const Scene& scene, const Rig& rig);

}  // namespace wheatstone
