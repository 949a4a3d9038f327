#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "wheatstone/image/image.h"
#include "wheatstone/stereo/disparity_from_depth.h"

namespace wheatstone {

/// A picture that carries its own depth, both upright.
struct CarriedDepth {
  Image<Rgb8> picture;
  Image<float> depth;  ///< of any size
  DepthKind kind = DepthKind::inverse;
  std::string how;  ///< where the file has it, as "the depth image of its HEIC file"
};

/// Reads a picture and the depth that its file carries; none where it has none:
/// - HEIC: the depth image of the main picture;
/// - JPEG: Google's depth map, within its XMP (GDepth) or behind the picture, as its XMP lists it (Dynamic Depth);
/// - any picture of colours whose right half is the grey depth of its left half: the halves' edges agree, and the right
///   one is smoother, or the name ends in the word "rgbd".
/// Throws Error{bad_input} where that depth is damaged.
std::optional<CarriedDepth> find_carried_depth(const std::filesystem::path& path);

/// Whether find_carried_depth would find some; false where the file cannot be read.
bool carries_depth(const std::filesystem::path& path);

/// Reads a picture whose left half is a photograph and whose right half its depth in grey, nearer is brighter, as `pack
/// --to rgbd` writes it. Throws Error{bad_input}.
CarriedDepth read_depth_beside(const std::filesystem::path& path);

}  // namespace wheatstone
