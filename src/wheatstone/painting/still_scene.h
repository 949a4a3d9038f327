#pragma once

#include <span>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/stereo/outer_view.h"

namespace wheatstone {

/// Views beside the eyes, for a scene that is to be seen from there, too: the outermost of the wanted views, and views
/// halfway there, at the photographs' scale. `zero_parallax_px` is that of make_outer_view.
std::vector<View> make_outer_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                   ViewRange wanted, float zero_parallax_px);

/// A pair as the scene that its painting is planned from, to be seen from all `wanted` views. The left eye is the
/// reference view; then come what only the right eye sees (its disparity is not before what the left eye shows there),
/// and what no photograph shows and views beside the eyes, or halfway between them, uncover: the latter in smaller
/// pictures where the photographs are large. With one photograph, the left one, the scene is that view alone. Borrows
/// the photographs and the left disparity.
std::vector<View> make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                   ViewRange wanted);

/// The scene of pictures of which everything is known, such as those of a model: the left eye, and `others` with the
/// parts that they show beside it, instead of those that make_still_scene finds. Borrows the pictures.
std::vector<View> make_known_scene(const StereoPairView& pictures, const StereoGeometryView& geometry,
                                   std::span<const View> others);

/// Sets the wanted pixels of each view except the first, which is whole: pixels whose points the views before it do not
/// show. Their disparities are exact, so this is known. Specks are left out.
void want_what_others_do_not_show(std::span<View> views);

}  // namespace wheatstone
