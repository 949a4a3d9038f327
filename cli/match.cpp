#include <fmt/format.h>

#include "commands.h"
#include "match_options.h"
#include "photograph_run.h"
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
  FolderArguments walk;  ///< of a folder
  std::string folder = "matched";
  MatchArguments matching;
};

/// The names of all files that `write` writes.
std::vector<std::string> result_names(bool rectified) {
  std::vector<std::string> names{"left_disparity.pfm",  "right_disparity.pfm", "left_disparity.png",
                                 "right_disparity.png", "disparity.png",       "confidence.png",
                                 "left_occlusion.png",  "right_occlusion.png"};
  if (rectified) names.insert(names.end(), {"left.png", "right.png"});
  return names;
}

void write(OutputFolder& output, const PreparedPair& pair, const MatchedPair& matched) {
  const StereoGeometry& geometry = matched.geometry;
  if (pair.rectification) {
    write_image(output.file("left.png"), pair.pictures.left);
    write_image(output.file("right.png"), pair.pictures.right);
  }
  write_disparity(output.file("left_disparity.pfm"), geometry.left_disparity);
  write_disparity(output.file("right_disparity.pfm"), geometry.right_disparity);
  write_disparity(output.file("left_disparity.png"), geometry.left_disparity);
  write_disparity(output.file("right_disparity.png"), geometry.right_disparity);
  write_image(output.file("disparity.png"), disparity_picture(geometry.left_disparity));
  write_image(output.file("confidence.png"), matched.left_confidence);
  write_image(output.file("left_occlusion.png"), geometry.left_occlusion);
  write_image(output.file("right_occlusion.png"), geometry.right_occlusion);
  output.commit();
}

PhotographResult match_one(const MatchCommandArguments& arguments, const Session& session) {
  // What cannot be written is said before the work.
  const StereoArguments& photographs = arguments.photographs;
  OutputFolder folder(arguments.folder, {photographs.left, photographs.right, arguments.matching.model});
  for (const std::string& name : result_names(photographs.rectify != RectifyPolicy::never)) folder.file(name);
  const ReadPhotograph read = read_photographs(photographs, false, session);
  const PreparedPair& pair = read.pair;
  const MatchOptions options = match_options_from(arguments.matching);
  const MatchedPair matched = match(pair.pictures, options, session.progress);
  const MatchConfidence confidence = measure_match(pair.pictures, matched, options.range);
  write(folder, pair, matched);
  tell_of_match(read, confidence, session);
  Report report{{{"folder", arguments.folder},
                 {"least_disparity_px", matched.range.least,
                  fmt::format("disparities looked for   {} to {} px", matched.range.least, matched.range.largest)},
                 {"largest_disparity_px", matched.range.largest},
                 {"left_found_share", matched.left_found_share,
                  fmt::format("found, not filled        {:.1f} % of the left view, {:.1f} % of the right",
                              100 * matched.left_found_share, 100 * matched.right_found_share)},
                 {"right_found_share", matched.right_found_share},
                 {"confidence", Json::parse(confidence_json(confidence)),
                  fmt::format("streaks                  {:.1f} % of the disparity map\n"
                              "patches                  {:.2f} % of it; {:.0f} % of the left view is plain\n"
                              "partners differ by       {:.1f} of 255 (median)",
                              100 * confidence.streak_share, 100 * confidence.patch_share, 100 * confidence.plain_share,
                              confidence.colour_difference)},
                 {"pair", Json::parse(preparation_json(pair)),
                  undecided_eyes(pair).empty() ? "" : fmt::format("eyes                     {}", undecided_eyes(pair))},
                 only_text(fmt::format("written to               {}", arguments.folder))}};
  if (read.whole.width > 0)
    report.facts.insert(report.facts.begin(),
                        Fact{"reduced_from",
                             {{"width", read.whole.width}, {"height", read.whole.height}},
                             fmt::format("reduced                  from {}x{} to {}x{} pixels", read.whole.width,
                                         read.whole.height, pair.pictures.left.width(), pair.pictures.left.height())});
  return {std::move(report), arguments.folder};
}

Report run_match(const MatchCommandArguments& arguments, const Session& session) {
  return work_on_photograph_or_pairs(arguments, "matched", match_one, session);
}

Rows match_command_rows(MatchCommandArguments& a) {
  return join({pair_rows(a.photographs),
               pair_folder_rows(a.walk, a.photographs, "matched"),
               {row("-o,--output", output_name(a.folder), "Folder for the results"), layout_row(a.photographs.layout),
                swap_row(a.photographs.swap), max_size_row(a.photographs.max_size), rectify_row(a.photographs.rectify)},
               match_rows(a.matching)});
}

}  // namespace

Command match_command() {
  return make_command(
      "match", "Estimate disparity and occlusion of a stereo pair", match_command_rows, run_match,
      R"(Writes left_disparity and right_disparity, each in its own view, as .pfm in pixels and as .png with 16 bits, which can
be edited and given back with paint --disparity; disparity.png to look at (near is red); confidence.png (white: found and
confirmed, grey: doubtful, black: filled from its surroundings); and the occlusion masks (white: the other eye does not
see it). Where the pair was rectified, left.png and right.png are the rectified pictures that they belong to.

Example:
  wheatstone synth still -o still
  wheatstone match still/left.png still/right.png -o matched
  wheatstone match photograph.mpo -o matched
  wheatstone match photographs -o matched)");
}

}  // namespace wheatstone::cli
