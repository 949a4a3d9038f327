#pragma once

#include <map>
#include <string>

#include "options.h"

#include "wheatstone/marks/style.h"

namespace wheatstone::cli {

/// A style as it is typed: a preset or file, and parameters that change it.
struct StyleArguments {
  std::string style = "oil";
  std::map<std::string, std::string> changes;  ///< by parameter name
};

Rows style_rows(StyleArguments& arguments);

/// Throws Error: wrong_usage, also for a parameter given that the style's kind of marks does not read; bad_input for a
/// style file.
Style style_from(const StyleArguments& arguments, std::uint64_t seed);

}  // namespace wheatstone::cli
