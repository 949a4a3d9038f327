#pragma once

#include <optional>

#include "content.h"
#include "frame_geometry.h"
#include "viewer.h"

namespace wheatstone::viewer {

/// The disparity of what is seen at a place, in pixels of the content; none where it is not known.
std::optional<float> disparity_at(const Content& content, const PlaceInView& place);

/// The disparity of what is seen at a pixel of a viewer's frame, in pixels of the content; none where it is not known.
std::optional<float> disparity_under(const Viewer& viewer, double x, double y);

}  // namespace wheatstone::viewer
