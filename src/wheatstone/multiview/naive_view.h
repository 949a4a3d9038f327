#pragma once

#include "wheatstone/depth/rig.h"
#include "wheatstone/image/image.h"
#include "wheatstone/multiview/scene.h"
#include "wheatstone/particles/cloud.h"

namespace wheatstone {

/// One view computed plainly: one thread, one particle after the other, exactly as the formulas say. The reference that
/// the renderers are tested against, and that they must be faster than.
Image<Rgb8> naive_view(const Cloud& cloud, const Scene& scene, const Rig& rig, ViewPosition view, float exposure);

}  // namespace wheatstone
