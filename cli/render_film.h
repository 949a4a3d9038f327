#pragma once

#include <CLI/CLI.hpp>

#include "command.h"
#include "render_options.h"

namespace wheatstone::cli {

void add_render_film_options(CLI::App& command, RenderFilmArguments& arguments);

/// Whether a run of `render` makes a film: of a series, or with a camera that moves.
bool makes_film(const CLI::App& command, const RenderArguments& arguments);

/// Throws Error{wrong_usage} for an option of films where none is made.
void refuse_film_options(const CLI::App& command);

/// Renders and writes a film, and says what became of it.
void run_render_film(const RenderArguments& arguments, const CLI::App& command, const Session& session);

}  // namespace wheatstone::cli
