#include <fmt/format.h>
#include <fmt/ostream.h>

#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "command.h"
#include "number_arguments.h"
#include "output_option.h"
#include "print_facts.h"
#include "study_kinds.h"
#include "typed_options.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/random.h"
#include "wheatstone/study/draw_graph.h"
#include "wheatstone/study/random_dots.h"

namespace wheatstone::cli {
namespace {

enum class Kind { planes, volume, dots };
constexpr std::array<std::pair<std::string_view, Kind>, 3> kinds{
    {{"planes", Kind::planes}, {"volume", Kind::volume}, {"dots", Kind::dots}}};

struct StudyStimuliArguments {
  Kind kind = Kind::planes;
  int count = 2;
  int nodes = 90;
  float depth_mm = 100;
  float disparity_arcsec = 400;
  int views = 2;
  float span = 1;
  std::string size = "1024x768";
  StudyScreen screen;
  std::string folder = "stimuli";
};

/// The names of a stimulus' views: "left" and "right" of two, else "view_00" and so on.
std::string view_name(const StudyStimuliArguments& arguments, int view) {
  if (arguments.views == 2 || arguments.kind == Kind::dots) return view == 0 ? "left" : "right";
  return fmt::format("view_{:03}", view);
}

void write_graph(const StudyStimuliArguments& arguments, int number, const OutputFolder& folder,
                 const Session& session) {
  const PathGraphOptions options{
      .nodes = arguments.nodes,
      .placement = arguments.kind == Kind::volume ? GraphPlacement::volume : GraphPlacement::planes,
      .depth_mm = arguments.depth_mm,
      .viewing_distance_mm = arguments.screen.viewing_distance_mm,
      .eye_separation_mm = arguments.screen.eye_separation_mm};
  const PathGraph graph =
      make_path_graph(options, hash_keys({session.seed, static_cast<std::uint64_t>(number)}), number % 2 == 0);
  write_whole_file(folder.file(fmt::format("graph_{:03}.json", number)), graph_json(graph));
  const Rig rig = evenly_spaced(arguments.screen.width_px, arguments.screen.height_px, arguments.views, arguments.span);
  for (int view = 0; view < arguments.views; ++view) {
    const EyePlace eye{
        rig.positions[static_cast<std::size_t>(view)].eye_separations() * arguments.screen.eye_separation_mm,
        arguments.screen.viewing_distance_mm};
    write_image(folder.file(fmt::format("graph_{:03}_{}.png", number, view_name(arguments, view))),
                draw_graph(graph, arguments.screen, eye));
  }
}

/// The side of the gap is drawn by lot; it stands in the file beside the pictures.
void write_dots(const StudyStimuliArguments& arguments, int number, const OutputFolder& folder,
                const Session& session) {
  constexpr std::array<std::string_view, 4> sides{"right", "below", "left", "above"};
  const std::uint64_t seed = hash_keys({session.seed, static_cast<std::uint64_t>(number)});
  const auto side = static_cast<std::size_t>(seed % sides.size());
  const StereoPair pair = random_dot_stereogram({.disparity_arcsec = arguments.disparity_arcsec}, arguments.screen,
                                                static_cast<RingGap>(side), seed);
  write_image(folder.file(fmt::format("dots_{:03}_left.png", number)), pair.left);
  write_image(folder.file(fmt::format("dots_{:03}_right.png", number)), pair.right);
  const nlohmann::ordered_json facts{{"kind", "random-dot stereogram"},
                                     {"seed", seed},
                                     {"gap", sides[side]},
                                     {"disparity_arcsec", arguments.disparity_arcsec}};
  write_whole_file(folder.file(fmt::format("dots_{:03}.json", number)), facts.dump() + "\n");
}

void run_study_stimuli(StudyStimuliArguments arguments, const Session& session) {
  const Size size = parse_size("--size", arguments.size, {64, 8192});
  arguments.screen.width_px = size.width;
  arguments.screen.height_px = size.height;
  OutputFolder folder(arguments.folder);
  for (int number = 0; number < arguments.count; ++number) {
    report(session.progress, "drawing stimuli", static_cast<double>(number) / arguments.count);
    if (arguments.kind == Kind::dots)
      write_dots(arguments, number, folder, session);
    else
      write_graph(arguments, number, folder, session);
  }
  folder.commit();
  if (session.json)
    print_facts({{"folder", arguments.folder}, {"stimuli", arguments.count}, {"seed", session.seed}}, session);
  else
    fmt::print(session.output, "written to {}\n", arguments.folder);
}

}  // namespace

void add_study_stimuli(CLI::App& study, const Session& session) {
  const auto arguments = std::make_shared<StudyStimuliArguments>();
  CLI::App& command = *study.add_subcommand("stimuli", "Draw graphs for path searching, or random-dot stereograms");
  command.fallthrough();
  add_output_option(command, arguments->folder, "Output folder");
  add_choice<Kind>(command, "--kind", arguments->kind, kinds,
                   "Graphs on three depth planes, or in a volume; dots: rings to test stereoscopic vision with");
  add_number(command, "--count", arguments->count, {1, 100'000}, "Number of stimuli");
  add_number(command, "--nodes", arguments->nodes, {9, 3000}, "Nodes of a graph, a multiple of three");
  add_length(command, "--depth", arguments->depth_mm, {0, 1000},
             "Depth range of a graph, half of it before the screen");
  add_number(command, "--disparity", arguments->disparity_arcsec, {1, 3600}, "Of a ring of dots, in seconds of arc");
  add_number(command, "--views", arguments->views, {1, 200}, "Number of views of a graph");
  add_number(command, "--span", arguments->span, {0.01, 20}, "From the first view to the last, in eye separations");
  command.add_option("--size", arguments->size, "Of a view, in pixels")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  add_length(command, "--screen-width", arguments->screen.width_mm, {50, 10'000}, "Width of the screen");
  add_length(command, "--distance", arguments->screen.viewing_distance_mm, {100, 10'000}, "Viewing distance");
  command.footer(
      "Examples:\n"
      "  wheatstone study stimuli --count 4 --nodes 90 --depth 10cm -o stimuli\n"
      "  wheatstone study stimuli --kind dots --disparity 40 -o screening");
  command.callback([arguments, &session] { run_study_stimuli(*arguments, session); });
}

}  // namespace wheatstone::cli
