#pragma once

// The synthetic still life that tests look at: rays take longer to cast than most tests do, so each is cast once.

#include <map>
#include <tuple>

#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {

/// With its exact geometry, of one sample a pixel; cast once a process, however often it is asked for.
inline const SyntheticStill& still_life(int width, int height, std::uint64_t seed = 1, bool converged = false) {
  static std::map<std::tuple<int, int, std::uint64_t, bool>, SyntheticStill> made;
  const auto [found, is_new] = made.try_emplace({width, height, seed, converged});
  if (is_new)
    found->second = make_synthetic_still(
        {.width = width, .height = height, .seed = seed, .samples_a_side = 1, .converged = converged});
  return found->second;
}

}  // namespace wheatstone
