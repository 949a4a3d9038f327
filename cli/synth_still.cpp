#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.h"
#include "output_option.h"
#include "size_argument.h"
#include "synth_kinds.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::cli {
namespace {

struct Arguments {
  std::string folder = "still";
  std::string size = "960x720";
  SyntheticStillOptions still;
  int views = 2;
  std::optional<float> view;
};

void write(const OutputFolder& output, const SyntheticStill& still) {
  write_image(output.file("left.png"), still.pictures.left);
  write_image(output.file("right.png"), still.pictures.right);
  write_disparity(output.file("left_disparity.pfm"), still.geometry.left_disparity);
  write_disparity(output.file("right_disparity.pfm"), still.geometry.right_disparity);
  write_image(output.file("left_occlusion.png"), still.geometry.left_occlusion);
  write_image(output.file("right_occlusion.png"), still.geometry.right_occlusion);
}

void write(const OutputFolder& output, const std::string& name, const SyntheticView& view) {
  write_image(output.file(name + ".png"), view.picture);
  write_disparity(output.file(name + "_disparity.pfm"), view.disparity);
}

void run(const Arguments& arguments, const Session& session) {
  SyntheticStillOptions options = arguments.still;
  options.seed = session.seed;
  take_size(arguments.size, options.width, options.height);

  OutputFolder output(arguments.folder);
  if (arguments.view) {
    write(output, "view", make_synthetic_view(options, ViewPosition(*arguments.view)));
  } else if (arguments.views == 2) {
    write(output, make_synthetic_still(options));
  } else {
    const Rig rig = evenly_spaced(options.width, options.height, arguments.views);
    for (int i = 0; i < arguments.views; ++i) {
      report(session.progress, "views", static_cast<double>(i) / arguments.views);
      write(output, fmt::format("view_{:03}", i), make_synthetic_view(options, rig.positions[i]));
    }
  }
  output.commit();
  if (session.json) {
    const nlohmann::ordered_json facts{
        {"folder", arguments.folder}, {"width", options.width}, {"height", options.height}, {"seed", options.seed}};
    fmt::print(session.output, "{}\n", facts.dump(2));
  } else {
    fmt::print(session.output, "written to {}\n", arguments.folder);
  }
}

}  // namespace

void add_synth_still(CLI::App& synth, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *synth.add_subcommand("still", "A still life on a table by a window, ray-cast");
  command.fallthrough();
  add_output_option(command, arguments->folder, "Folder for the results");
  command.add_option("--size", arguments->size, "Of each view: WIDTHxHEIGHT")->capture_default_str();
  command.add_option("--samples", arguments->still.samples_a_side, "Samples along each side of a pixel")
      ->check(CLI::Range(1, 8))
      ->capture_default_str();
  command.add_option("--largest-disparity", arguments->still.largest_disparity_px,
                     "Of the nearest point, in pixels; 45 in a picture 640 wide if not given");
  command.add_option("--least-disparity", arguments->still.least_disparity_px,
                     "Of the wall, in pixels; 6 in a picture 640 wide if not given");
  command.add_flag("--converged", arguments->still.converged, "Disparity 0 in the middle of the range: mixed signs");
  CLI::Option* views = command.add_option("--views", arguments->views, "Views from the left eye to the right")
                           ->check(CLI::Range(1, 1000))
                           ->capture_default_str();
  command
      .add_option("--view", arguments->view, "Only the view at this position: left eye -0.5, centre 0, right eye 0.5")
      ->check(CLI::Range(-10.0, 10.0))
      ->excludes(views);
  command.footer(
      "Two views are written as left.png and right.png with left_disparity.pfm, left_occlusion.png and so on: exact, "
      "in\n"
      "pixels, each in its own view. Other numbers of views are written as view_000.png with view_000_disparity.pfm.\n"
      "--seed moves and recolours what lies on the table.\n\n"
      "Example:\n  wheatstone synth still -o still --size 1280x960 --seed 2");
  command.callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace wheatstone::cli
