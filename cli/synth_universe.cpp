#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "commands.h"
#include "wheatstone/error.h"
#include "wheatstone/synthetic/synthetic_universe.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

struct SynthUniverseArguments {
  std::string file = "universe.hdf5";
  std::vector<double> times;
  SyntheticUniverseOptions universe;
};

std::vector<double> parse_times(const std::string& option, const std::string& text) {
  if (text.empty()) return {};
  const auto count = static_cast<std::size_t>(std::ranges::count(text, ',')) + 1;
  std::vector<double> times = parse_numbers(option, text, {',', count, {0.001, 1}, "scale factors A1,A2,..."});
  if (std::ranges::adjacent_find(times, std::greater_equal<>()) != times.end())
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected scale factors that ascend", option, text));
  return times;
}

/// One snapshot for each of the times, whose particles can be followed from one to the next.
void write_series(const SynthUniverseArguments& arguments, const Session& session) {
  const std::vector<double>& times = arguments.times;
  const std::optional<FramePattern> pattern = frame_pattern(arguments.file);
  if (!pattern)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format(
            "--output: is '{}', expected a name with a number for the snapshots of --times, as universe_%03d.hdf5",
            arguments.file));
  SyntheticUniverseOptions options = arguments.universe;
  options.motion = true;
  for (std::size_t i = 0; i < times.size(); ++i) {
    options.redshift = 1 / times[i] - 1;
    write_synthetic_universe(pattern->file(static_cast<std::int64_t>(i)), options, session.progress);
  }
}

Report run_synth_universe(const SynthUniverseArguments& given, const Session& session) {
  SynthUniverseArguments arguments = given;
  SyntheticUniverseOptions& options = arguments.universe;
  options.seed = session.seed;
  const bool is_series = !arguments.times.empty();
  if (is_series) {
    write_series(arguments, session);
  } else {
    write_synthetic_universe(arguments.file, options, session.progress);
  }
  const Fact when_seen = is_series ? Fact{"times", arguments.times} : Fact{"redshift", options.redshift};
  return {{{"file", arguments.file, fmt::format("written to {}", arguments.file)},
           {"particles", options.particles},
           when_seen,
           {"seed", options.seed}}};
}

Rows synth_universe_rows(SynthUniverseArguments& a) {
  SyntheticUniverseOptions& universe = a.universe;
  return {row("-o,--output", output_name(a.file), "Snapshot file"),
          row("--particles", number(universe.particles, {1, 1e11}), "Number of particles"),
          row("--redshift", number(universe.redshift, {0, 1000}), "Redshift; 0 is today"),
          row("--box", number(universe.box_mpc_h, {1, 10'000}), "Side of the periodic box, in Mpc/h"),
          row("--times", parsed(a.times, parse_times),
              "Scale factors A1,A2,... of a series of snapshots with IDs and velocities; 1 is today. --output has a "
              "place for their numbers, which begin at 0: universe_%03d.hdf5",
              {}, {}, {"--redshift"})};
}

}  // namespace

Command synth_universe_command() {
  return make_command("universe", "Gas of the cosmic web, as a GADGET-4 HDF5 snapshot", synth_universe_rows,
                      run_synth_universe,
                      R"(Examples:
  wheatstone synth universe --particles 1000000 --redshift 0 --seed 7 -o universe.hdf5
  wheatstone synth universe --particles 100000 --times 0.4,0.5,0.6 -o universe_%03d.hdf5)");
}

}  // namespace wheatstone::cli
