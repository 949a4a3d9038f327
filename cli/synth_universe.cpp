#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "output_option.h"
#include "print_facts.h"
#include "synth_kinds.h"
#include "typed_options.h"
#include "wheatstone/particles/write_gadget.h"
#include "wheatstone/synthetic/synthetic_universe.h"

namespace wheatstone::cli {
namespace {

struct Arguments {
  std::string file = "universe.hdf5";
  SyntheticUniverseOptions universe;
};

void run(const Arguments& arguments, const Session& session) {
  SyntheticUniverseOptions options = arguments.universe;
  options.seed = session.seed;
  SyntheticUniverse universe(options, session.progress);
  GadgetWriter writer(arguments.file, {.particles = options.particles,
                                       .box_size = universe.box_size(),
                                       .redshift = options.redshift,
                                       .mass_of_a_particle = universe.mass_of_a_particle()});
  constexpr std::size_t chunk = 1'000'000;
  std::uint64_t written = 0;
  while (written < options.particles) {
    report(session.progress, "particles", static_cast<double>(written) / static_cast<double>(options.particles));
    const Cloud cloud = universe.next(chunk);
    writer.add(cloud);
    written += cloud.size();
  }
  writer.commit();
  if (session.json) {
    const nlohmann::ordered_json facts{
        {"file", arguments.file}, {"particles", written}, {"redshift", options.redshift}, {"seed", options.seed}};
    print_facts(facts, session);
  } else {
    fmt::print(session.output, "written to {}\n", arguments.file);
  }
}

}  // namespace

void add_synth_universe(CLI::App& synth, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *synth.add_subcommand("universe", "Gas of the cosmic web, as a GADGET-4 HDF5 snapshot");
  command.fallthrough();
  add_output_option(command, arguments->file, "Snapshot file");
  SyntheticUniverseOptions& universe = arguments->universe;
  add_number(command, "--particles", universe.particles, {1, 1e11}, "Number of particles");
  add_number(command, "--redshift", universe.redshift, {0, 1000}, "Redshift; 0 is today");
  add_number(command, "--box", universe.box_mpc_h, {1, 10'000}, "Side of the periodic box, in Mpc/h");
  command.footer("Example:\n  wheatstone synth universe --particles 1000000 --redshift 0 --seed 7 -o universe.hdf5");
  command.callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace wheatstone::cli
