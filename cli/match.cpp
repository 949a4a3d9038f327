#include <fmt/format.h>
#include <fmt/ostream.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "match_options.h"
#include "output_option.h"
#include "print_facts.h"
#include "stereo_arguments.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/report.h"
#include "wheatstone/display/disparity_picture.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::cli {
namespace {

struct MatchCommandArguments {
  StereoArguments photographs;
  std::string folder = "matched";
  MatchArguments matching;
};

/// The names of all files that `write` writes.
std::vector<std::string> result_names(bool rectified) {
  std::vector<std::string> names{"left_disparity.pfm",  "right_disparity.pfm", "left_disparity.png",
                                 "right_disparity.png", "left_occlusion.png",  "right_occlusion.png"};
  if (rectified) names.insert(names.end(), {"left.png", "right.png"});
  return names;
}

void write(OutputFolder& output, const PreparedPair& pair, const StereoGeometry& geometry) {
  if (pair.rectification) {
    write_image(output.file("left.png"), pair.pictures.left);
    write_image(output.file("right.png"), pair.pictures.right);
  }
  write_disparity(output.file("left_disparity.pfm"), geometry.left_disparity);
  write_disparity(output.file("right_disparity.pfm"), geometry.right_disparity);
  write_image(output.file("left_disparity.png"), disparity_picture(geometry.left_disparity));
  write_image(output.file("right_disparity.png"), disparity_picture(geometry.right_disparity));
  write_image(output.file("left_occlusion.png"), geometry.left_occlusion);
  write_image(output.file("right_occlusion.png"), geometry.right_occlusion);
  output.commit();
}

void run_match(const MatchCommandArguments& arguments, const CLI::App& command, const Session& session) {
  refuse_match_options_without_effect(command, arguments.matching, {});
  // What cannot be written is said before the work.
  const StereoArguments& photographs = arguments.photographs;
  OutputFolder folder(arguments.folder, {photographs.left, photographs.right, arguments.matching.model});
  for (const std::string& name : result_names(photographs.rectify != RectifyPolicy::never)) folder.file(name);
  const ReadPhotograph read = read_photographs(photographs, false, session);
  const PreparedPair& pair = read.pair;
  const MatchOptions options = match_options_from(arguments.matching);
  const MatchedPair matched = match(pair.pictures, options, session.progress);
  const MatchConfidence confidence = measure_match(pair.pictures, matched, options.range);
  write(folder, pair, matched.geometry);
  tell_of_match(read, confidence, session);
  if (session.json) {
    nlohmann::ordered_json facts{{"folder", arguments.folder},
                                 {"least_disparity_px", matched.range.least},
                                 {"largest_disparity_px", matched.range.largest},
                                 {"left_found_share", matched.left_found_share},
                                 {"right_found_share", matched.right_found_share},
                                 {"confidence", nlohmann::ordered_json::parse(confidence_json(confidence))},
                                 {"pair", nlohmann::ordered_json::parse(preparation_json(pair))}};
    if (read.whole.width > 0) facts["reduced_from"] = {{"width", read.whole.width}, {"height", read.whole.height}};
    print_facts(facts, session);
    return;
  }
  if (read.whole.width > 0)
    fmt::print(session.output, "reduced                  from {}x{} to {}x{} pixels\n", read.whole.width,
               read.whole.height, pair.pictures.left.width(), pair.pictures.left.height());
  fmt::print(session.output, "disparities looked for   {} to {} px\n", matched.range.least, matched.range.largest);
  fmt::print(session.output, "found, not filled        {:.1f} % of the left view, {:.1f} % of the right\n",
             100 * matched.left_found_share, 100 * matched.right_found_share);
  fmt::print(session.output, "streaks                  {:.1f} % of the disparity map\n", 100 * confidence.streak_share);
  fmt::print(session.output, "partners differ by       {:.1f} of 255 (median)\n", confidence.colour_difference);
  if (const std::string_view note = undecided_eyes(pair); !note.empty())
    fmt::print(session.output, "eyes                     {}\n", note);
  fmt::print(session.output, "written to               {}\n", arguments.folder);
}

}  // namespace

void add_match_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<MatchCommandArguments>();
  CLI::App& command = *program.add_subcommand("match", "Estimate disparity and occlusion of a stereo pair");
  command
      .add_option("LEFT", arguments->photographs.left,
                  "Left photograph; or one file with both views: MPO, JPS, side by side, one above the other")
      ->required();
  command.add_option("RIGHT", arguments->photographs.right, "Right photograph, of the same size");
  add_output_option(command, arguments->folder, "Folder for the results");
  add_stereo_options(command, arguments->photographs);
  add_rectify_option(command, arguments->photographs.rectify);
  add_match_options(command, arguments->matching);
  command.footer(
      "Writes left_disparity.pfm and right_disparity.pfm (pixels, each in its own view), pictures of them (near is "
      "red),\n"
      "and the occlusion masks (white: the other eye does not see it); where the pair was rectified also left.png and "
      "right.png,\nthe rectified pictures that they belong to.\n\n"
      "Example:\n  wheatstone synth still -o still\n  wheatstone match still/left.png still/right.png -o matched\n"
      "  wheatstone match photograph.mpo -o matched");
  command.callback([arguments, &command, &session] { run_match(*arguments, command, session); });
}

}  // namespace wheatstone::cli
