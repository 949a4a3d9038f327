#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "number_arguments.h"
#include "output_option.h"
#include "print_facts.h"
#include "synth_kinds.h"
#include "typed_options.h"
#include "wheatstone/error.h"
#include "wheatstone/synthetic/synthetic_universe.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

struct SynthUniverseArguments {
  std::string file = "universe.hdf5";
  std::string times;
  SyntheticUniverseOptions universe;
};

std::vector<double> parse_times(const std::string& text) {
  if (text.empty()) return {};
  const auto count = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
  std::vector<double> times = parse_numbers("--times", text, {',', count, {0.001, 1}, "scale factors A1,A2,..."});
  if (std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end())
    throw Error(ErrorKind::wrong_usage, fmt::format("--times: is '{}', expected scale factors that ascend", text));
  return times;
}

/// One snapshot for each of the times, whose particles can be followed from one to the next.
void write_series(const SynthUniverseArguments& arguments, const std::vector<double>& times, const Session& session) {
  const std::optional<FramePattern> pattern = frame_pattern(arguments.file);
  if (!pattern)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--output: is '{}', expected a name with a number for the snapshots of --times, as "
                            "universe_%03d.hdf5",
                            arguments.file));
  SyntheticUniverseOptions options = arguments.universe;
  options.motion = true;
  for (std::size_t i = 0; i < times.size(); ++i) {
    options.redshift = 1 / times[i] - 1;
    write_synthetic_universe(pattern->file(static_cast<std::int64_t>(i)), options, session.progress);
  }
}

void run_synth_universe(SynthUniverseArguments arguments, const Session& session) {
  SyntheticUniverseOptions& options = arguments.universe;
  options.seed = session.seed;
  const std::vector<double> times = parse_times(arguments.times);
  if (times.empty()) {
    write_synthetic_universe(arguments.file, options, session.progress);
  } else {
    write_series(arguments, times, session);
  }
  if (!session.json) {
    fmt::print(session.output, "written to {}\n", arguments.file);
    return;
  }
  nlohmann::ordered_json facts{{"file", arguments.file}, {"particles", options.particles}};
  if (times.empty()) {
    facts["redshift"] = options.redshift;
  } else {
    facts["times"] = times;
  }
  facts["seed"] = options.seed;
  print_facts(facts, session);
}

}  // namespace

void add_synth_universe(CLI::App& synth, const Session& session) {
  auto arguments = std::make_shared<SynthUniverseArguments>();
  CLI::App& command = *synth.add_subcommand("universe", "Gas of the cosmic web, as a GADGET-4 HDF5 snapshot");
  command.fallthrough();
  add_output_option(command, arguments->file, "Snapshot file");
  SyntheticUniverseOptions& universe = arguments->universe;
  add_number(command, "--particles", universe.particles, {1, 1e11}, "Number of particles");
  CLI::Option* redshift = add_number(command, "--redshift", universe.redshift, {0, 1000}, "Redshift; 0 is today");
  add_number(command, "--box", universe.box_mpc_h, {1, 10'000}, "Side of the periodic box, in Mpc/h");
  command
      .add_option("--times", arguments->times,
                  "Scale factors A1,A2,..., of which 1 is today: a series of snapshots with IDs and velocities, whose "
                  "numbers from 0 on stand in --output, as universe_%03d.hdf5")
      ->excludes(redshift);
  command.footer(
      "Examples:\n"
      "  wheatstone synth universe --particles 1000000 --redshift 0 --seed 7 -o universe.hdf5\n"
      "  wheatstone synth universe --particles 100000 --times 0.4,0.5,0.6 -o universe_%03d.hdf5");
  command.callback([arguments, &session] { run_synth_universe(*arguments, session); });
}

}  // namespace wheatstone::cli
