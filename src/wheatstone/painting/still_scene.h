#pragma once

#include <span>
#include <vector>

#include "wheatstone/marks/view_range.h"
#include "wheatstone/stereo/outer_view.h"

namespace wheatstone {

/// What the outermost of the wanted views show beside the eyes, and views halfway there, in pictures of the
/// photographs' size. `zero_parallax_px` is as make_outer_view has it.
std::vector<OuterView> make_outer_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                        ViewRange wanted, float zero_parallax_px);

/// Adds them to a scene, which borrows them.
void append_views(std::span<const OuterView> outer, std::vector<SceneView>& scene);

/// A pair as the scene that its painting is planned from: the left eye as the reference view, what only the right eye
/// sees, and what no photograph shows and views beside the eyes, or halfway between them, uncover: the latter in
/// smaller pictures where the photographs are large.
struct StillScene {
  Image<std::uint8_t> right_only;  ///< 255 for what the left eye's disparity does not tell of the right eye's view
  Image<float> right_disparity;    ///< the right eye's, there not before what the left eye shows
  std::vector<OuterView> outer;
  std::vector<SceneView> views;  ///< refer to these and to the photographs
};

/// A scene that can be seen from all `wanted` views. Of one photograph, the left one, it is that view alone.
StillScene make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewRange wanted);

}  // namespace wheatstone
