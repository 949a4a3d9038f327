#pragma once

#include <functional>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// Particles as they come: calls a visitor with every chunk, in order. It may be called again, and then gives the same
/// chunks. Where ranks share the work it gives them chunks in turn, and in step: each is visited equally often, the
/// last time perhaps with nothing.
using Chunks = std::function<void(const std::function<void(const Cloud& chunk)>& visit)>;

/// The chunks of a cloud in memory, which must stay: the whole cloud. Ranks, each of which has the whole cloud, take
/// parts of it in turn.
Chunks chunks_of(const Cloud& cloud, const Ranks& ranks = {});

}  // namespace wheatstone
