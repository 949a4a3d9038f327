#include <fmt/format.h>

#include <array>
#include <optional>

#include "commands.h"
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

constexpr std::array<Choice<bool>, 2> cameras{{{"ideal", false}, {"phone", true}}};

struct SynthStillArguments {
  std::string folder = "still";
  PictureSize size{960, 720};
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

Report run_synth_still(const SynthStillArguments& arguments, const Session& session) {
  SyntheticStillOptions options = arguments.still;
  options.seed = session.seed;
  options.width = arguments.size.width;
  options.height = arguments.size.height;

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
  return {{{"folder", arguments.folder, fmt::format("written to {}", arguments.folder)},
           {"width", options.width},
           {"height", options.height},
           {"seed", options.seed}}};
}

Rows synth_still_rows(SynthStillArguments& a) {
  return {row("-o,--output", output_name(a.folder), "Folder for the results"),
          row("--size", size(a.size, {16, 32768}), "Size of each view: WIDTHxHEIGHT"),
          row("--samples", number(a.still.samples_a_side, {1, 8}), "Samples along each side of a pixel"),
          row("--largest-disparity", number(a.still.largest_disparity_px, {-65535, 65535}),
              "Disparity of the nearest point in pixels; 45 per 640 pixels of width by default"),
          row("--least-disparity", number(a.still.least_disparity_px, {-65535, 65535}),
              "Disparity of the wall in pixels; 6 per 640 pixels of width by default"),
          row("--converged", flag(a.still.converged),
              "Put disparity 0 in the middle of the range, so that both signs occur"),
          row("--views", number(a.views, view_count_range), "Number of views from the left eye to the right eye"),
          row("--view", number(a.view, {-10, 10}),
              "Write one view only, at this position: left eye -0.5, centre 0, right eye 0.5", {}, {}, {"--views"}),
          row("--camera", choice(a.phone, cameras), "Cameras that take the two views", {}, {}, {"--views", "--view"})};
}

}  // namespace

Command synth_still_command() {
  return make_command(
      "still", "Ray-cast still life on a table by a window", synth_still_rows, run_synth_still,
      R"(Two views are written as left.png and right.png with left_disparity.pfm, left_occlusion.png and so on: exact, in
pixels, each in its own view. Other numbers of views are written as view_000.png with view_000_disparity.pfm.
--camera phone takes two views as hand-held cameras do: turned by up to 2 degrees about each axis, with lens
distortion (k1 = -0.05), unlike exposure, noise and JPEG compression. It writes left.jpg, right.jpg, and
left_to_right.flo, the exact way from each left pixel to its partner.
--seed changes the positions and colours of the objects on the table.

Example:
  wheatstone synth still -o still --size 1280x960 --seed 2)");
}

}  // namespace wheatstone::cli
