#pragma once

#include <span>
#include <vector>

#include "wheatstone/multiview/splat_internal.h"
#include "wheatstone/multiview/view_light_internal.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// Sends each splat to the rank that owns its band. Returns the received blocks in the order of their ranks, from rank
/// 0 on; each holds only the splats of this rank's bands.
std::vector<std::vector<SplatBlock>> deal_out(std::vector<std::vector<SplatBlock>> blocks, const SplatOrders& orders,
                                              const Ranks& ranks);

/// Exchanges the bands of a picture's targets: every rank sends its own, to all ranks or to the first only.
void share_bands(const SplatOrder& order, std::span<const ViewTarget> targets, bool to_all, const Ranks& ranks);

}  // namespace wheatstone
