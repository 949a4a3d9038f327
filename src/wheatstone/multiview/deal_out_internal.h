#pragma once

#include <span>
#include <vector>

#include "wheatstone/multiview/splat_internal.h"
#include "wheatstone/multiview/view_light_internal.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// Gives each rank the splats of its bands, of all ranks' blocks: block by block as they were, first those of rank 0,
/// without the splats of other ranks' bands.
std::vector<std::vector<SplatBlock>> deal_out(std::vector<std::vector<SplatBlock>> blocks, const SplatOrders& orders,
                                              const Ranks& ranks);

/// Gives this rank's bands of a picture's targets to all ranks, or to the first only, and takes theirs.
void share_bands(const SplatOrder& order, std::span<const ViewTarget> targets, bool to_all, const Ranks& ranks);

}  // namespace wheatstone
