#pragma once

#include <functional>

#include "wheatstone/particles/cloud.h"

namespace wheatstone {

/// Particles as they come: calls a visitor with every chunk, in order. It may be called again, and then gives the same
/// chunks.
using Chunks = std::function<void(const std::function<void(const Cloud& chunk)>& visit)>;

/// The chunks of a cloud in memory, which must stay: the whole cloud.
inline Chunks chunks_of(const Cloud& cloud) {
  return [&cloud](const std::function<void(const Cloud&)>& visit) { visit(cloud); };
}

}  // namespace wheatstone
