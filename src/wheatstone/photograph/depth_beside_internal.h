#pragma once

#include <filesystem>
#include <optional>

#include "wheatstone/photograph/carried_depth.h"

namespace wheatstone {

/// The picture and the depth of a file whose halves, next to each other, look like these; none where they do not.
/// A name that ends in the word "rgbd" is believed where the right half is grey. Throws as read_image.
std::optional<CarriedDepth> find_depth_beside(const std::filesystem::path& path);

}  // namespace wheatstone
