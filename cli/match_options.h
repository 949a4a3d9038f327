#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "wheatstone/matching/match.h"

namespace wheatstone::cli {

/// The options of matching as they are typed.
struct MatchArguments {
  std::string quality = "good";
  std::string matcher = "census";
  std::string model;
  std::string model_values = "255";
  std::string range;
  int block_px = MatchOptions().block_px;
  bool no_left_right_check = false;
  std::string refine;  ///< empty: as the quality has it
};

/// The heading of these options in the help.
inline constexpr auto match_options_group = "Matching";

void add_match_options(CLI::App& command, MatchArguments& arguments);

/// Throws Error{wrong_usage}.
MatchOptions match_options_from(const MatchArguments& arguments);

/// Throws Error{wrong_usage} for an option that has no effect beside the others, or for any where the disparity is
/// given: `disparity_given` says by what, as "with --disparity", and is empty where it is not.
void refuse_match_options_without_effect(const CLI::App& command, const MatchArguments& arguments,
                                         const std::string& disparity_given);

}  // namespace wheatstone::cli
