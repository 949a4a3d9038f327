#pragma once

#include <span>
#include <vector>

#include "wheatstone/marks/view_range.h"
#include "wheatstone/stereo/outer_view.h"

namespace wheatstone {

/// What the outermost of the wanted views show beside the eyes, and views halfway there, of the photographs' scale, for
/// a scene to be seen from there, too. `zero_parallax_px` is as make_outer_view has it.
std::vector<View> make_outer_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                   ViewRange wanted, float zero_parallax_px);

/// A pair as the scene that its painting is planned from, to be seen from all `wanted` views. The left eye is the
/// reference view; then come what only the right eye sees (its disparity is not before what the left eye shows there),
/// and what no photograph shows and views beside the eyes, or halfway between them, uncover: the latter in smaller
/// pictures where the photographs are large. Of one photograph, the left one, it is that view alone. Borrows the
/// photographs and the left disparity.
std::vector<View> make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                   ViewRange wanted);

/// The scene of pictures of which all is known, as those of a model: the left eye, and `others` with what they show
/// beside it, in place of what make_still_scene finds. Borrows the pictures.
std::vector<View> make_known_scene(const StereoPairView& pictures, const StereoGeometryView& geometry,
                                   std::span<const View> others);

/// Sets of each view but the first, which is whole, what is wanted of it: pixels whose point the views before it do not
/// show, which is known because their disparities are exact. Specks are left out.
void want_what_others_do_not_show(std::span<View> views);

}  // namespace wheatstone
