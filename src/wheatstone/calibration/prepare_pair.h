#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "wheatstone/progress.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Whether a pair is rectified before it is matched.
enum class RectifyPolicy {
  never,   ///< the pictures are taken as they are
  always,  ///< as `rectify` does, from what the pictures have in common
};

std::span<const std::string_view> rectify_policy_names();
std::optional<RectifyPolicy> rectify_policy_by_name(std::string_view name);

struct PreparePairOptions {
  RectifyPolicy rectify = RectifyPolicy::never;
};

/// A pair that can be matched, and how well its rows fit.
struct PreparedPair {
  StereoPair pictures;  ///< upright, of one scene; rectified where that was asked for
  bool rectified = false;
  int compared_features = 0;                ///< that both pictures show
  std::optional<double> row_difference_px;  ///< median |y_left − y_right| of those features; none: too few to tell
  double tolerated_row_difference_px = 1;   ///< up to which a pair counts as rectified
};

/// Looks for what makes two pictures no pair, and rectifies them where that is wanted. The rows are measured on
/// features (SIFT) of copies whose longer side is at most 960 pixels, a fifth of the time that matching takes. Throws
/// Error{bad_input}: sizes differ; a picture is blank; one of them is upside down, turned by 90 degrees or mirrored
/// against the other; they show different scenes; and as `rectify` where the pair is to be rectified.
PreparedPair prepare_pair(StereoPair photographs, const PreparePairOptions& options = {},
                          const Progress& progress = {});

/// One sentence that names the row difference and what helps; empty where the rows fit or could not be compared.
std::string row_warning(const PreparedPair& pair);

}  // namespace wheatstone
