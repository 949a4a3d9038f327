#pragma once

#include <string>

#include "wheatstone/share/page.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A photograph of two views, or of one and its depth (stereo/single_view.h), for a page: its pictures on the surfaces
/// that they show, and for views beside the eyes what `make_still_scene` continues.
SharedPicture share_photograph(const StereoPair& photographs, const StereoGeometry& geometry, const std::string& title);

}  // namespace wheatstone
