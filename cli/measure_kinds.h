#pragma once

#include "command.h"

namespace wheatstone::cli {

// What can be measured, each in its own file.
void add_measure_film(CLI::App& measure, const Session& session);
void add_measure_painting(CLI::App& measure, const Session& session);
void add_measure_stereo(CLI::App& measure, const Session& session);
void add_measure_views(CLI::App& measure, const Session& session);

}  // namespace wheatstone::cli
