#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <utility>

#include "command.h"
#include "number_arguments.h"
#include "output_option.h"
#include "print_facts.h"
#include "synth_kinds.h"
#include "typed_options.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/motion/flow_file.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/synthetic/phone_camera.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<std::pair<std::string_view, bool>, 2> cameras{{{"ideal", false}, {"phone", true}}};

struct SynthStillArguments {
  std::string folder = "still";
  std::string size = "960x720";
  SyntheticStillOptions still;
  int views = 2;
  bool phone = false;
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

void write(const OutputFolder& output, const PhonePair& pair) {
  constexpr int jpeg_quality = 85;
  write_whole_file(output.file("left.jpg"), encode_jpeg(pair.pictures.left, jpeg_quality));
  write_whole_file(output.file("right.jpg"), encode_jpeg(pair.pictures.right, jpeg_quality));
  write_flow(output.file("left_to_right.flo"), pair.left_to_right);
}

void write(const OutputFolder& output, const std::string& name, const SyntheticView& view) {
  write_image(output.file(name + ".png"), view.picture);
  write_disparity(output.file(name + "_disparity.pfm"), view.disparity);
}

void run_synth_still(const SynthStillArguments& arguments, const Session& session) {
  SyntheticStillOptions options = arguments.still;
  options.seed = session.seed;
  const Size size = parse_size("--size", arguments.size, {16, 32768});
  options.width = size.width;
  options.height = size.height;

  OutputFolder output(arguments.folder);
  if (arguments.phone) {
    write(output, make_phone_pair(options, {}, session.progress));
  } else if (arguments.view) {
    write(output, "view", make_synthetic_view(options, ViewPosition(*arguments.view), session.progress));
  } else if (arguments.views == 2) {
    write(output, make_synthetic_still(options, session.progress));
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
    print_facts(facts, session);
  } else {
    fmt::print(session.output, "written to {}\n", arguments.folder);
  }
}

}  // namespace

void add_synth_still(CLI::App& synth, const Session& session) {
  auto arguments = std::make_shared<SynthStillArguments>();
  CLI::App& command = *synth.add_subcommand("still", "Ray-cast still life on a table by a window");
  command.fallthrough();
  add_output_option(command, arguments->folder, "Folder for the results");
  command.add_option("--size", arguments->size, "Size of each view: WIDTHxHEIGHT")->capture_default_str();
  add_number(command, "--samples", arguments->still.samples_a_side, {1, 8}, "Samples along each side of a pixel");
  add_number(command, "--largest-disparity", arguments->still.largest_disparity_px, {-65535, 65535},
             "Disparity of the nearest point in pixels; 45 per 640 pixels of width by default");
  add_number(command, "--least-disparity", arguments->still.least_disparity_px, {-65535, 65535},
             "Disparity of the wall in pixels; 6 per 640 pixels of width by default");
  command.add_flag("--converged", arguments->still.converged,
                   "Put disparity 0 in the middle of the range, so that both signs occur");
  CLI::Option* views = add_number(command, "--views", arguments->views, view_count_range,
                                  "Number of views from the left eye to the right eye");
  CLI::Option* view = add_number(command, "--view", arguments->view, {-10, 10},
                                 "Write one view only, at this position: left eye -0.5, centre 0, right eye 0.5")
                          ->excludes(views);
  add_choice<bool>(command, "--camera", arguments->phone, cameras, "Cameras that take the two views")
      ->excludes(views)
      ->excludes(view);
  command.footer(
      "Two views are written as left.png and right.png with left_disparity.pfm, left_occlusion.png and so on: exact, "
      "in\n"
      "pixels, each in its own view. Other numbers of views are written as view_000.png with view_000_disparity.pfm.\n"
      "--camera phone takes two views as hand-held cameras do: turned by up to 2 degrees about each axis, with lens\n"
      "distortion (k1 = -0.05), unlike exposure, noise and JPEG compression. It writes left.jpg, right.jpg, and\n"
      "left_to_right.flo, the exact way from each left pixel to its partner.\n"
      "--seed changes the positions and colours of the objects on the table.\n\n"
      "Example:\n  wheatstone synth still -o still --size 1280x960 --seed 2");
  command.callback([arguments, &session] { run_synth_still(*arguments, session); });
}

}  // namespace wheatstone::cli
