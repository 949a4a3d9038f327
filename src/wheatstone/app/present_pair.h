#pragma once

#include <optional>
#include <span>
#include <vector>

#include "wheatstone/marks/painting.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How far apart two eyes look at a painting, in its own eye separations, at most 1: near enough together for the
/// disparities from the scene's farthest point to its nearest, but for outliers, to take no more than `depth_budget` of
/// the width. 1 where there is no budget, or the painting has no surfaces.
float comfortable_separation(const Painting& painting, std::optional<float> depth_budget);

/// The views of two eyes that are so far apart; none where they are the painting's own.
std::vector<ViewPosition> presented_views(float separation);

/// A painting as two eyes look at it on a screen: `eyes`, its pictures for the two eyes, or where `separation` is less
/// than 1 pictures for eyes that are nearer together, on which the disparity `zero_parallax_px` of the eyes' lies on
/// the screen.
StereoPair present_pair(const Painting& painting, const StereoPairView& eyes, float separation, float zero_parallax_px);

/// The same; `presented` are its pictures for the views of presented_views.
StereoPair present_pair(std::span<const Image<Rgb8>> presented, const StereoPairView& eyes, float separation,
                        float zero_parallax_px);

}  // namespace wheatstone
