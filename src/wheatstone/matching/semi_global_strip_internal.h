#pragma once

#include <cstddef>
#include <cstdint>
#include <opencv2/core.hpp>
#include <vector>

#include "wheatstone/matching/semi_global_internal.h"

namespace wheatstone {

/// Half sides of the census.
inline constexpr int census_across = 4, census_down = 3;
/// Bytes beside each row that may be read, and bands are rounded up to a multiple of them.
inline constexpr int row_margin = 32, band_step = 16;

/// What is compared. The right picture is seen in a mirror, so that its pixels lie in the order of growing disparities.
struct ComparedPictures {
  cv::Mat left, right;            ///< 8-bit RGB
  cv::Mat left_grey, right_grey;  ///< with a border of half the census' sides, and of row_margin on the right
  bool one_band;                  ///< the same for every pixel
};

/// Rows of the pictures, `top` to `bottom`, of which `begin` to `end` are decided; the rest leads the paths into them.
struct Strip {
  int top, begin, end, bottom;
};

/// Memory for the costs of a strip and their sums along paths; kept from strip to strip.
struct StripMemory {
  std::vector<std::uint8_t> costs;
  std::vector<std::uint16_t> sums;
};

/// Matches one strip into `result`. The same bytes with every instruction set.
void match_strip(const ComparedPictures& pictures, const SearchBand& band, const Strip& strip, StripMemory& memory,
                 BandMatch& result);

}  // namespace wheatstone
