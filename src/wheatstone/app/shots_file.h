#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "wheatstone/video/frame.h"

namespace wheatstone {

// A shots file (TOML) says where the shots of a film begin, and how each is painted: one [[shot]] a shot, in order.

/// A shot as it was found.
struct FoundShot {
  std::int64_t begin = 0;   ///< frame, counted from 0
  std::int64_t frames = 0;  ///< how many it has
  double begin_s = 0;       ///< time of its first frame
  double length_s = 0;
  std::string thumbnail;  ///< name of the picture beside the file
};

/// Shots as a shots file that changes nothing: what may be set for a shot stands there as a comment.
std::string shots_file_text(std::span<const FoundShot> shots);

}  // namespace wheatstone
