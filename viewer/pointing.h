#pragma once

#include <optional>

#include "content.h"
#include "frame_geometry.h"
#include "viewer.h"

namespace wheatstone::viewer {

/// The disparity of what is seen at a place, in pixels of the content; none where it is not known.
std::optional<float> disparity_at(const Content& content, const PlaceInView& place);

/// A place of what is shown.
struct SeenPlace {
  float x = 0, y = 0;      ///< pixels of the view in which a painting's depth moves nothing, its reference view
  float disparity_px = 0;  ///< without more depth where somebody looks
};

/// What is seen at a pixel of a viewer's frame; none where its depth is not known.
std::optional<SeenPlace> seen_at(const Viewer& viewer, double x, double y);

/// The disparity of what is seen at a pixel of a viewer's frame, in pixels of the content; none where it is not known.
std::optional<float> disparity_under(const Viewer& viewer, double x, double y);

}  // namespace wheatstone::viewer
