#include "command.h"
#include "synth_kinds.h"

namespace wheatstone::cli {

void add_synth_command(CLI::App& program, const Session& session) {
  CLI::App& synth = *program.add_subcommand("synth", "Make synthetic input with exact ground truth");
  synth.require_subcommand(1);
  synth.get_formatter()->label("SUBCOMMAND", "KIND");
  synth.footer("Example:\n  wheatstone synth still -o still");
  add_synth_film(synth, session);
  add_synth_still(synth, session);
  add_synth_universe(synth, session);
}

}  // namespace wheatstone::cli
