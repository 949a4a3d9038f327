#pragma once

#include <span>
#include <string>

#include "render_options.h"

namespace wheatstone::cli {

/// The options of `render` that other programs have: those of its views; all but those of output files, films and
/// streams.
Rows call_rows(RenderArguments& arguments);

/// The arguments of a call of another program. `file` is empty where the particles come from elsewhere. Throws
/// Error{wrong_usage} as set_rows does, and for options without effect.
RenderArguments arguments_of_call(const std::string& file, std::span<const NamedWords> options);

}  // namespace wheatstone::cli
