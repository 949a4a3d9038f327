#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <string>
#include <utility>

#include "commands.h"
#include "photograph_folder.h"
#include "stereo_arguments.h"
#include "wheatstone/app/comfort_stimuli.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/random.h"
#include "wheatstone/study/draw_graph.h"
#include "wheatstone/study/instructions_page.h"
#include "wheatstone/study/random_dots.h"
#include "wheatstone/study/study_design.h"

namespace wheatstone::cli {
namespace {

enum class StimulusKind { planes, volume, dots, comfort };
constexpr std::array<Choice<StimulusKind>, 4> stimulus_kinds{{{"planes", StimulusKind::planes},
                                                              {"volume", StimulusKind::volume},
                                                              {"dots", StimulusKind::dots},
                                                              {"comfort", StimulusKind::comfort}}};

struct StudyStimuliArguments {
  StimulusKind kind = StimulusKind::planes;
  int count = 2;
  int nodes = 90;
  float depth_mm = 100;
  float disparity_arcsec = 400;
  int views = 2;
  float span = 1;
  PictureSize size{1024, 768};
  StudyScreen screen;
  std::string photographs;  ///< a folder, for comfort
  std::string style = "oil";
  std::string folder = "stimuli";
};

/// The names of a stimulus' views: "left" and "right" of two, else "view_00" and so on.
std::string view_name(const StudyStimuliArguments& arguments, int view) {
  if (arguments.views == 2 || arguments.kind == StimulusKind::dots) return view == 0 ? "left" : "right";
  return fmt::format("view_{:03}", view);
}

void write_graph(const StudyStimuliArguments& arguments, int number, const OutputFolder& folder,
                 const Session& session) {
  const PathGraphOptions options{
      .nodes = arguments.nodes,
      .placement = arguments.kind == StimulusKind::volume ? GraphPlacement::volume : GraphPlacement::planes,
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
  const Json facts{{"kind", "random-dot stereogram"},
                   {"seed", seed},
                   {"gap", sides[side]},
                   {"disparity_arcsec", arguments.disparity_arcsec}};
  write_whole_file(folder.file(fmt::format("dots_{:03}.json", number)), facts.dump() + "\n");
}

void write_pair(const StereoPair& pair, const std::string& name, const std::string& version,
                const OutputFolder& folder) {
  write_image(folder.file(fmt::format("stimuli/{}_{}_left.png", name, version)), pair.left);
  write_image(folder.file(fmt::format("stimuli/{}_{}_right.png", name, version)), pair.right);
}

/// Each photograph as it is, painted for both eyes, and painted for each; the design of their study; what people read.
Report run_comfort(const StudyStimuliArguments& arguments, const Session& session) {
  if (arguments.photographs.empty())
    throw Error(ErrorKind::wrong_usage, "comfort: needs --photographs, a folder of stereo photographs");
  StereoArguments given{.max_size = std::max(arguments.size.width, arguments.size.height)};
  const PhotographList list = pairs_in_folder(arguments.photographs, given, {}, {arguments.folder, {}, {}}, session);
  std::vector<std::string> names;
  for (std::size_t i = 0; i < list.jobs.size(); ++i) names.push_back(fmt::format("{:02}", i + 1));
  const std::string toml = comfort_design(names);
  const StudyDesign design = parse_study_design(toml, "design.toml");
  OutputFolder folder(arguments.folder, {arguments.photographs});
  std::filesystem::create_directory(folder.folder() / "stimuli");
  std::string sources = "item\tphotograph\n";
  for (std::size_t i = 0; i < list.jobs.size(); ++i) {
    const Progress progress = [&](std::string_view /*step*/, double done) {
      report(session.progress, fmt::format("photograph {} of {}", i + 1, list.jobs.size()),
             (static_cast<double>(i) + done) / static_cast<double>(list.jobs.size()));
    };
    PaintPhotographOptions options{.style = style_by_name(arguments.style)};
    options.style.seed = session.seed;
    Session of_one = session;
    of_one.progress = progress;
    const ReadPhotograph read = read_photographs(photograph_of(given, list.jobs[i]), false, of_one);
    const ComfortVersions versions = comfort_versions(read.pair.pictures, options, progress);
    write_pair(versions.original, names[i], "original", folder);
    write_pair(versions.consistent, names[i], "consistent", folder);
    write_pair(versions.inconsistent, names[i], "inconsistent", folder);
    sources += fmt::format("{}\t{}\n", names[i], list.jobs[i].left);
  }
  write_whole_file(folder.file("design.toml"), toml);
  write_whole_file(folder.file("photographs.tsv"), sources);
  write_whole_file(folder.file("instructions.html"), instructions_page(design, arguments.folder));
  folder.commit();
  return {{{"folder", arguments.folder, fmt::format("written to {}", arguments.folder)},
           {"photographs", names.size(), fmt::format("photographs: {}, in three versions each", names.size())},
           {"subjects", design.subjects},
           {"trials", condition_count(design) * design.repetitions,
            fmt::format("trials of a subject: {}", condition_count(design) * design.repetitions)},
           {"seed", session.seed},
           only_text(fmt::format("next: print {0}/instructions.html, then wheatstone study run {0}/design.toml "
                                 "--subject 1 -o {0}",
                                 arguments.folder))}};
}

Report run_study_stimuli(const StudyStimuliArguments& given, const Session& session) {
  if (given.kind == StimulusKind::comfort) return run_comfort(given, session);
  StudyStimuliArguments arguments = given;
  arguments.screen.width_px = given.size.width;
  arguments.screen.height_px = given.size.height;
  OutputFolder folder(arguments.folder);
  for (int number = 0; number < arguments.count; ++number) {
    report(session.progress, "drawing stimuli", static_cast<double>(number) / arguments.count);
    if (arguments.kind == StimulusKind::dots)
      write_dots(arguments, number, folder, session);
    else
      write_graph(arguments, number, folder, session);
  }
  folder.commit();
  return {{{"folder", arguments.folder, fmt::format("written to {}", arguments.folder)},
           {"stimuli", arguments.count},
           {"seed", session.seed}}};
}

Rows stimuli_rows(StudyStimuliArguments& a) {
  const Reason on_comfort =
      when([&a] { return a.kind == StimulusKind::comfort; }, "on photographs; it works on graphs and dots");
  const Reason others =
      when([&a] { return a.kind != StimulusKind::comfort; }, "on graphs and dots; it works on comfort");
  const Rows all{
      row("kind,--kind", choice(a.kind, stimulus_kinds),
          "Graphs on three depth planes, or in a volume; dots: rings to test stereoscopic vision with; comfort: "
          "photographs, painted consistently and not"),
      row("-o,--output", output_name(a.folder), "Output folder; of comfort that of the study"),
      row("--photographs", of_type("FOLDER", text(a.photographs)), "Stereo photographs, for comfort", {others}),
      row("--style", text(a.style), "Style in which they are painted", {others}),
      row("--size", of_type("WIDTHxHEIGHT", size(a.size, {64, 8192})),
          "Of a view, in pixels; of photographs, whose shape is kept, the longer side")};
  const Rows drawn{
      row("--count", number(a.count, {1, 100'000}), "Number of stimuli"),
      row("--nodes", number(a.nodes, {9, 3000}), "Nodes of a graph, a multiple of three"),
      row("--depth", length(a.depth_mm, {0, 1000}), "Depth range of a graph, half of it before the screen"),
      row("--disparity", number(a.disparity_arcsec, {1, 3600}), "Of a ring of dots, in seconds of arc"),
      row("--views", number(a.views, {1, 200}), "Number of views of a graph"),
      row("--span", number(a.span, {0.01, 20}), "From the first view to the last, in eye separations"),
      row("--screen-width", length(a.screen.width_mm, {50, 10'000}), "Width of the screen"),
      row("--distance", length(a.screen.viewing_distance_mm, {100, 10'000}), "Viewing distance")};
  return join({all, under({}, drawn, {on_comfort})});
}

}  // namespace

Command study_stimuli_command() {
  return make_command(
      "stimuli",
      "Draw graphs for path searching or random-dot stereograms, or paint photographs for a study of comfort",
      stimuli_rows, run_study_stimuli,
      R"(Examples:
  wheatstone study stimuli --count 4 --nodes 90 --depth 10cm -o stimuli
  wheatstone study stimuli --kind dots --disparity 40 -o screening
  wheatstone study stimuli comfort --photographs photographs -o comfort)");
}

}  // namespace wheatstone::cli
