#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "output_option.h"
#include "picture_format.h"
#include "print_facts.h"
#include "stereo_arguments.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/report.h"
#include "wheatstone/calibration/rectify.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::cli {
namespace {

struct RectifyArguments {
  StereoArguments photographs;
  std::string folder = "rectified";
  std::string format = "png";
  std::string calibration;
  bool match_colour = true;
};

/// The library knows pictures, not files; what it says of them gets their names.
RectifiedPair rectified(const RectifyArguments& arguments, const Session& session) {
  const NamedPair read = read_named_pair(arguments.photographs);
  const RectifyOptions options{.match_colour = arguments.match_colour};
  std::optional<StereoCalibration> calibration;
  if (!arguments.calibration.empty()) calibration = read_stereo_calibration(arguments.calibration);
  try {
    RectifiedPair pair = calibration ? rectify(read.pictures, *calibration, options, session.progress)
                                     : rectify(read.pictures, options, session.progress);
    tell_of_layout(read, session);
    return pair;
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::bad_input) throw;
    throw Error(error.kind(), fmt::format("{}: {}", read.name, error.what()));
  }
}

void print_json(const RectifiedPair& pair, const RectifyArguments& arguments, const Session& session) {
  const auto vertical = [&](const VerticalDisparity& of) -> nlohmann::ordered_json {
    if (pair.measured_matches == 0) return nullptr;
    return {{"median_px", of.median_px}, {"percentile_95_px", of.percentile_95_px}};
  };
  nlohmann::ordered_json facts{{"folder", arguments.folder},
                               {"width", pair.pictures.left.width()},
                               {"height", pair.pictures.left.height()},
                               {"measured_matches", pair.measured_matches},
                               {"vertical_disparity_before", vertical(pair.before)},
                               {"vertical_disparity_after", vertical(pair.after)},
                               {"shift_px", pair.shift_px},
                               {"eyes_swapped", pair.eyes_swapped},
                               {"colour", nullptr},
                               {"rectification", nullptr}};
  if (pair.colour) facts["colour"] = {{"gain", pair.colour->gain}, {"gamma", pair.colour->gamma}};
  if (pair.rectification)
    facts["rectification"] = nlohmann::ordered_json::parse(rectification_json(*pair.rectification));
  print_facts(facts, session);
}

void print_summary(const RectifiedPair& pair, const RectifyArguments& arguments, const Session& session) {
  if (pair.measured_matches == 0) {
    fmt::print(session.output, "rows                  not measured: the pictures have too few features in common\n");
  } else {
    fmt::print(session.output,
               "rows differed by      {:.2f} px, median; {:.2f} px, 95th percentile of {} feature matches\n",
               pair.before.median_px, pair.before.percentile_95_px, pair.measured_matches);
    fmt::print(session.output, "rows differ by        {:.2f} px, median; {:.2f} px, 95th percentile\n",
               pair.after.median_px, pair.after.percentile_95_px);
  }
  fmt::print(session.output, "kept                  {}x{} pixels\n", pair.pictures.left.width(),
             pair.pictures.left.height());
  if (pair.shift_px > 0) {
    fmt::print(session.output, "horizontal shift      {:.0f} px, so that all disparities are at least 0\n",
               pair.shift_px);
  } else {
    fmt::print(session.output, "horizontal shift      none{}\n",
               pair.eyes_swapped ? "" : ": all disparities are at least 0");
  }
  if (pair.colour) {
    const auto& [gain, gamma] = *pair.colour;
    fmt::print(session.output,
               "colour of the right   red {:.3f}, green {:.3f}, blue {:.3f} times; gamma {:.3f}, {:.3f}, {:.3f}\n",
               gain[0], gain[1], gain[2], gamma[0], gamma[1], gamma[2]);
  } else if (arguments.match_colour) {
    fmt::print(session.output, "colour of the right   left as it is: too few features to compare\n");
  }
  if (pair.eyes_swapped)
    fmt::print(
        session.output,
        "note                  the left picture is that of the camera on the right: left and right are swapped\n");
  fmt::print(session.output, "written to            {}\n", arguments.folder);
}

void run_rectify(const RectifyArguments& arguments, const Session& session) {
  // Before the work, so that what cannot be written is known at once.
  OutputFolder folder(arguments.folder,
                      {arguments.photographs.left, arguments.photographs.right, arguments.calibration});
  const std::filesystem::path left = folder.file(fmt::format("left.{}", arguments.format));
  const std::filesystem::path right = folder.file(fmt::format("right.{}", arguments.format));
  const RectifiedPair pair = rectified(arguments, session);
  write_image(left, pair.pictures.left);
  write_image(right, pair.pictures.right);
  folder.commit();
  if (session.json) {
    print_json(pair, arguments, session);
  } else {
    print_summary(pair, arguments, session);
  }
}

}  // namespace

void add_rectify_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<RectifyArguments>();
  CLI::App& command =
      *program.add_subcommand("rectify", "Rectify two photographs: matching points come to lie on the same rows");
  command
      .add_option("LEFT", arguments->photographs.left,
                  "Left photograph; or one file with both views: MPO, JPS, side by side, one above the other")
      ->required();
  command.add_option("RIGHT", arguments->photographs.right, "Right photograph, of the same size");
  add_layout_options(command, arguments->photographs);
  add_output_option(command, arguments->folder, "Folder for left.png and right.png");
  add_picture_format(command, arguments->format, "File format of the rectified pictures");
  command.add_option(
      "--calibration", arguments->calibration,
      "Calibration file of the stereo rig (from 'wheatstone calibrate' or OpenCV); matched features are used by "
      "default");
  command.add_flag("--match-colour,!--no-match-colour", arguments->match_colour,
                   "Match exposure and colour of the right photograph to the left; on by default");
  command.footer(
      "Both pictures are cropped to what is filled in both, on the same rows and columns. Disparities (x_left - "
      "x_right)\n"
      "stay about what they were; where some would be below 0 the right picture is shifted, and the report says by\n"
      "how much.\n\n"
      "Examples:\n  wheatstone rectify left.jpg right.jpg -o rectified\n"
      "  wheatstone rectify photograph.mpo -o rectified\n"
      "  wheatstone paint rectified/left.png rectified/right.png -o painted");
  command.callback([arguments, &session] { run_rectify(*arguments, session); });
}

}  // namespace wheatstone::cli
