#pragma once

#include <string>
#include <string_view>

#include "wheatstone/study/study_design.h"

namespace wheatstone {

/// Whether a name is one of the settings that decide what is shown.
bool is_setting(std::string_view name);

/// Throws Error{bad_input} that begins with `where` for a name or value that cannot be.
void apply_setting(std::string_view name, const std::string& value, ShownSettings& shown, std::string_view where);

}  // namespace wheatstone
