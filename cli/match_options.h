#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "wheatstone/stereo/match.h"

namespace wheatstone::cli {

/// The options of matching as they are typed.
struct MatchArguments {
  std::string matcher = "sgbm";
  std::string range;
  int block_px = MatchOptions().block_px;
  bool no_check = false;
  std::string refine = "none";
};

void add_match_options(CLI::App& command, MatchArguments& arguments);

/// Throws Error{wrong_usage}.
MatchOptions match_options_from(const MatchArguments& arguments);

}  // namespace wheatstone::cli
