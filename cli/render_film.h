#pragma once

#include "command.h"
#include "render_arguments.h"

namespace wheatstone::cli {

/// Renders and writes a film, and says what became of it.
Report run_render_film(const RenderArguments& given, const Session& session);

}  // namespace wheatstone::cli
