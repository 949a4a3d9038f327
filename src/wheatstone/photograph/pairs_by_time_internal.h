#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/photograph/find_photographs.h"

namespace wheatstone {

/// Two pictures of two cameras that were released together, and those that are not surely such.
struct PairsByTime {
  std::vector<FoundPhotograph> photographs;  ///< the stem is that of the left picture
  std::vector<LeftOutFile> left_out;
};

/// Looks for pairs among pictures of one view: two that were taken within two seconds of each other, by their EXIF
/// data, and of which no third was; of one size, but for a few rows; that show one scene from two places
/// (pair_evidence), with depth in it; and that themselves show whose eye's each is (eye_order). What is not all of this
/// is left out with its reason: no wrong pair is better than one more.
PairsByTime pairs_by_time(const std::vector<std::filesystem::path>& files, const Progress& progress);

}  // namespace wheatstone
