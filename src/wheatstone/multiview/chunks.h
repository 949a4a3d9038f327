#pragma once

#include <functional>

#include "wheatstone/particles/cloud.h"
#include "wheatstone/ranks/ranks.h"

namespace wheatstone {

/// Particles as they come: calls a visitor with every chunk, in order. It may be called again, and then gives the same
/// chunks. If ranks share the work, they take chunks in turn and in step: each rank is called equally often, the last
/// time possibly with an empty chunk.
using Chunks = std::function<void(const std::function<void(const Cloud& chunk)>& visit)>;

/// The chunks of a cloud in memory, which must outlive them. A single rank gets the whole cloud at once; several ranks,
/// each of which has the whole cloud, take parts of it in turn.
Chunks chunks_of(const Cloud& cloud, const Ranks& ranks = {});

}  // namespace wheatstone
