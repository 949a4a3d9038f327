#pragma once

#include <string>

#include "options.h"

#include "wheatstone/matching/match.h"

namespace wheatstone::cli {

/// The options of matching as they are typed.
struct MatchArguments {
  std::string quality = "good";
  std::string matcher = "census";
  std::string model;
  std::string model_values = "255";
  std::optional<DisparityRange> range;
  int block_px = MatchOptions().block_px;
  bool no_left_right_check = false;
  std::string refine;  ///< empty: as the quality has it
};

/// Refused where they have no effect beside each other.
Rows match_rows(MatchArguments& arguments);

/// Throws Error{wrong_usage}.
MatchOptions match_options_from(const MatchArguments& arguments);

}  // namespace wheatstone::cli
