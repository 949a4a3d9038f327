#pragma once

#include "wheatstone/depth/rig.h"
#include "wheatstone/image/image.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/particles/cloud.h"

namespace wheatstone {

/// One view by the book: one thread, one particle after the other, in the formulas' own words. The truth that the
/// renderers are tested against, and the opponent that they must be faster than.
Image<Rgb8> naive_view(const Cloud& cloud, const Scene& scene, const Rig& rig, ViewPosition view, float exposure);

}  // namespace wheatstone
