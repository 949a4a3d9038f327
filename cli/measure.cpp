#include "command.h"
#include "measure_kinds.h"

namespace wheatstone::cli {

void add_measure_command(CLI::App& program, const Session& session) {
  CLI::App& measure = *program.add_subcommand("measure", "Measure the consistency of a result");
  measure.require_subcommand(1);
  measure.get_formatter()->label("SUBCOMMAND", "WHAT");
  measure.footer(
      "Example:\n  wheatstone measure stereo painted/left.png painted/right.png --photographs left.png right.png");
  add_measure_film(measure, session);
  add_measure_painting(measure, session);
  add_measure_stereo(measure, session);
  add_measure_views(measure, session);
}

}  // namespace wheatstone::cli
