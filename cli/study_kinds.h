#pragma once

#include "command.h"

namespace wheatstone::cli {

// The kinds of `wheatstone study`.
void add_study_analyse(CLI::App& study, const Session& session);
void add_study_design(CLI::App& study, const Session& session);
void add_study_run(CLI::App& study, const Session& session);
void add_study_simulate(CLI::App& study, const Session& session);
void add_study_stimuli(CLI::App& study, const Session& session);

}  // namespace wheatstone::cli
