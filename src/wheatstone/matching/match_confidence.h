#pragma once

#include <optional>
#include <string>

#include "wheatstone/matching/match.h"

namespace wheatstone {

/// How the range of disparities that was asked for does not fit a pair.
struct RangeMisfit {
  DisparityRange asked;
  DisparityRange present;  ///< what the pair has
  double cut_share = 0;  ///< of the left view: at an end of the range beyond which the pair has more; 0: it is too wide
};

/// How sure a pair's disparity is, told from the pictures and the disparity alone. All but the difference are shares,
/// 0..1.
struct MatchConfidence {
  double found_share = 0;   ///< of the left view: found before anything was filled, and confirmed by the right view
  double streak_share = 0;  ///< of a copy of 640 columns: as its row is, but not as its column is (`streak_share`)
  double patch_share = 0;   ///< of a copy of 800 columns: unlike its surroundings without an edge there (`patch_share`)
  double colour_difference = 0;  ///< median of |left − right| of partners, mean of the channels, 0..255
  double plain_share = 0;        ///< of the left view: nothing but noise
  double overlap_share = 0;      ///< of the left view: its partner lies within the right picture
  double sharper_share = 0;      ///< of fine detail in the blurrier picture against the other; 1: alike
  bool left_is_blurrier = false;
  double depth_px = 0;               ///< between the 2nd and the 98th percentile of the disparity
  double middle_px = 0;              ///< its median
  std::optional<RangeMisfit> range;  ///< none: the range fits, or none was asked for
};

/// `asked_range` is the one that the pair was matched with, where one was asked for. Where much of the disparity is at
/// its ends the pair is searched for more beyond, in a fifth of the time that matching takes.
MatchConfidence measure_match(const StereoPair& pair, const MatchedPair& matched,
                              const std::optional<DisparityRange>& asked_range = {});

/// One sentence that names the likeliest reason why a match is poor, and what helps; empty where it is good: at least
/// 70 % found, at most 3 % streaks, some depth, in a range that fits. Rows that differ are told by row_warning.
std::string match_warning(const MatchConfidence& confidence);

}  // namespace wheatstone
