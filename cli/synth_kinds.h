#pragma once

#include "command.h"

namespace wheatstone::cli {

// The kinds of synthetic input, each in its own file.
void add_synth_film(CLI::App& synth, const Session& session);
void add_synth_still(CLI::App& synth, const Session& session);
void add_synth_universe(CLI::App& synth, const Session& session);

}  // namespace wheatstone::cli
