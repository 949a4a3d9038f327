#pragma once

#include <span>
#include <string_view>

namespace wheatstone::viewer {

/// What somebody looks with, and how pictures are put on the screen for it.
struct LookingWith {
  std::string_view name;     ///< "red-cyan"
  std::string_view text;     ///< for people
  std::string_view mode;     ///< an output mode
  std::string_view display;  ///< a display preset; empty: any
};

/// The first is that of somebody who has not said anything: no glasses.
std::span<const LookingWith> devices();

/// Throws Error{wrong_usage} that lists the names.
const LookingWith& find_device(std::string_view name);

}  // namespace wheatstone::viewer
