#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/image/known_runs.h"

namespace wheatstone {

/// The disparities of a surface in few bytes, rounded to `disparity_steps` a pixel: for each pixel the difference from
/// what its neighbours let expect, as four planes of bytes, deflated (zlib). docs/painting-file.md has the whole.
std::vector<std::uint8_t> encode_disparities(const KnownRuns& disparity);

/// The same disparities from their bytes; nothing where these are not exactly those of a surface of this size, which
/// has pixels.
std::optional<KnownRuns> decode_disparities(std::span<const std::uint8_t> bytes, int width, int height);

}  // namespace wheatstone
