#include "command.h"
#include "study_kinds.h"

namespace wheatstone::cli {

void add_study_command(CLI::App& program, const Session& session) {
  CLI::App& study = *program.add_subcommand("study", "Plan, run, simulate and analyse experiments with people");
  study.require_subcommand(1);
  study.get_formatter()->label("SUBCOMMAND", "KIND");
  study.footer("Example:\n  wheatstone study stimuli --count 4 -o stimuli");
  add_study_analyse(study, session);
  add_study_design(study, session);
  add_study_run(study, session);
  add_study_simulate(study, session);
  add_study_stimuli(study, session);
}

}  // namespace wheatstone::cli
