#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "wheatstone/matching/match.h"

namespace wheatstone::cli {

/// The options of matching as they are typed.
struct MatchArguments {
  std::string quality = "good";
  std::string matcher = "sgbm";
  std::string model;
  std::string model_values = "255";
  std::string range;
  int block_px = MatchOptions().block_px;
  bool no_check = false;
  std::string refine;  ///< empty: as the quality has it
};

void add_match_options(CLI::App& command, MatchArguments& arguments);

/// Throws Error{wrong_usage}.
MatchOptions match_options_from(const MatchArguments& arguments);

}  // namespace wheatstone::cli
