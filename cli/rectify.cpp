#include <fmt/format.h>

#include "commands.h"
#include "photograph_run.h"
#include "stereo_arguments.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/report.h"
#include "wheatstone/calibration/rectify.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

struct RectifyArguments {
  StereoArguments photographs;
  FolderArguments walk;  ///< of a folder
  std::string folder = "rectified";
  std::string format = "png";
  std::string calibration;
  bool match_colour = true;
};

/// The library knows pictures, not files; what it says of them gets their names.
RectifiedPair rectified(const NamedPair& read, const RectifyArguments& arguments, const Session& session) {
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

Json json_of(const VerticalDisparity& disparity, const RectifiedPair& pair) {
  if (pair.measured_matches == 0) return nullptr;
  return {{"median_px", disparity.median_px}, {"percentile_95_px", disparity.percentile_95_px}};
}

std::string rows_text(const RectifiedPair& pair) {
  if (pair.measured_matches == 0)
    return "rows                  not measured: the pictures have too few features in common";
  return fmt::format(
      "rows differed by      {:.2f} px, median; {:.2f} px, 95th percentile of {} feature matches\n"
      "rows differ by        {:.2f} px, median; {:.2f} px, 95th percentile",
      pair.before.median_px, pair.before.percentile_95_px, pair.measured_matches, pair.after.median_px,
      pair.after.percentile_95_px);
}

std::string shift_text(const RectifiedPair& pair) {
  if (pair.shift_px > 0)
    return fmt::format("horizontal shift      {:.0f} px, so that all disparities are at least 0", pair.shift_px);
  return fmt::format("horizontal shift      none{}", pair.eyes_swapped ? "" : ": all disparities are at least 0");
}

std::string colour_text(const RectifiedPair& pair, const RectifyArguments& arguments) {
  if (!pair.colour)
    return arguments.match_colour ? "colour of the right   left as it is: too few features to compare" : "";
  const auto& [gain, gamma] = *pair.colour;
  return fmt::format("colour of the right   red {:.3f}, green {:.3f}, blue {:.3f} times; gamma {:.3f}, {:.3f}, {:.3f}",
                     gain[0], gain[1], gain[2], gamma[0], gamma[1], gamma[2]);
}

std::string kept_text(const RectifiedPair& pair) {
  if (!pair.rectification) return {};
  return fmt::format(", {:.0f} % of the photographs' area", 100 * kept_area(*pair.rectification));
}

Report report_of(const RectifiedPair& pair, const RectifyArguments& arguments) {
  const int width = pair.pictures.left.width(), height = pair.pictures.left.height();
  Json colour, rectification;
  if (pair.colour) colour = {{"gain", pair.colour->gain}, {"gamma", pair.colour->gamma}};
  if (pair.rectification) rectification = Json::parse(rectification_json(*pair.rectification));
  return {
      {{"folder", arguments.folder},
       {"measured_matches", pair.measured_matches, rows_text(pair)},
       {"vertical_disparity_before", json_of(pair.before, pair)},
       {"vertical_disparity_after", json_of(pair.after, pair)},
       {"width", width, fmt::format("kept                  {}x{} pixels{}", width, height, kept_text(pair))},
       {"height", height},
       {"kept_area", pair.rectification ? Json(kept_area(*pair.rectification)) : Json()},
       {"shift_px", pair.shift_px, shift_text(pair)},
       {"colour", colour, colour_text(pair, arguments)},
       {"eyes_swapped", pair.eyes_swapped,
        pair.eyes_swapped
            ? "note                  the left picture is that of the camera on the right: left and right are swapped"
            : ""},
       {"rectification", rectification},
       only_text(fmt::format("written to            {}", arguments.folder))}};
}

PhotographResult rectify_one(const RectifyArguments& arguments, const Session& session) {
  // Before the work, so that what cannot be written is known at once.
  OutputFolder folder(arguments.folder,
                      {arguments.photographs.left, arguments.photographs.right, arguments.calibration});
  const std::filesystem::path left = folder.file(fmt::format("left.{}", arguments.format));
  const std::filesystem::path right = folder.file(fmt::format("right.{}", arguments.format));
  StereoArguments photographs = arguments.photographs;
  photographs.keep_profile = takes_profile(left);
  const NamedPair read = read_named_pair(photographs);
  const RectifiedPair pair = rectified(read, arguments, session);
  const PictureNotes notes{.colour_profile = read.colour_profile};
  write_image(left, pair.pictures.left, notes);
  write_image(right, pair.pictures.right, notes);
  folder.commit();
  return {report_of(pair, arguments), arguments.folder};
}

Report run_rectify(const RectifyArguments& arguments, const Session& session) {
  return work_on_photograph_or_pairs(arguments, "rectified", rectify_one, session);
}

Rows rectify_rows(RectifyArguments& a) {
  return join({pair_rows(a.photographs),
               pair_folder_rows(a.walk, a.photographs, "rectified"),
               {layout_row(a.photographs.layout), swap_row(a.photographs.swap),
                row("-o,--output", output_name(a.folder), "Folder for left.png and right.png"),
                row("--format", picture_format(a.format), "File format of the rectified pictures"),
                row("--calibration", text(a.calibration),
                    "Calibration file of the stereo rig (from 'wheatstone calibrate' or OpenCV); matched features are "
                    "used by default"),
                row("--match-colour,!--no-match-colour", flag(a.match_colour),
                    "Match exposure and colour of the right photograph to the left; on by default")}});
}

}  // namespace

Command rectify_command() {
  return make_command(
      "rectify", "Rectify two photographs: matching points come to lie on the same rows", rectify_rows, run_rectify,
      R"(Both pictures are cropped to what is filled in both, on the same rows and columns. Disparities (x_left - x_right)
stay about what they were; where some would be below 0 the right picture is shifted, and the report says by
how much.

Examples:
  wheatstone rectify left.jpg right.jpg -o rectified
  wheatstone rectify photograph.mpo -o rectified
  wheatstone rectify photographs -o rectified
  wheatstone paint rectified/left.png rectified/right.png -o painted)");
}

}  // namespace wheatstone::cli
