#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "commands.h"
#include "wheatstone/calibration/calibration.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  std::string folder;
  std::vector<std::string> left, right;
  PictureSize board{11, 7};  ///< inner corners
  double square_mm = 30;
  std::string output = "calibration.yml";
};

/// left* and right* with the same rest of the name.
std::vector<PictureFiles> pairs_in(const fs::path& folder) {
  std::error_code error;
  const fs::directory_iterator entries(folder, error);
  if (error)
    throw Error(ErrorKind::bad_input, fmt::format("{}: cannot be read ({}), expected a folder of pictures",
                                                  folder.string(), error.message()));
  std::map<std::string, PictureFiles> by_rest;
  for (const fs::directory_entry& entry : entries) {
    if (!entry.is_regular_file(error)) continue;
    const std::string name = entry.path().filename().string();
    if (name.starts_with("left")) by_rest[name.substr(4)].left = entry.path();
    if (name.starts_with("right")) by_rest[name.substr(5)].right = entry.path();
  }
  std::vector<PictureFiles> pairs;
  for (const auto& [rest, files] : by_rest) {
    if (files.left.empty() || files.right.empty())
      throw Error(ErrorKind::bad_input, fmt::format("{}: has no partner, expected {}{} beside it",
                                                    (files.left.empty() ? files.right : files.left).string(),
                                                    files.left.empty() ? "left" : "right", rest));
    pairs.push_back(files);
  }
  if (pairs.empty())
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: holds no pairs of pictures, expected left_01.png, right_01.png and so on", folder.string()));
  return pairs;
}

std::vector<PictureFiles> files_from(const CalibrateArguments& arguments) {
  const bool lists = !arguments.left.empty() || !arguments.right.empty();
  if (lists == !arguments.folder.empty())
    throw Error(ErrorKind::wrong_usage, "calibrate needs a folder, or --left and --right with a list of pictures each");
  if (!lists) return pairs_in(arguments.folder);
  if (arguments.left.size() != arguments.right.size())
    throw Error(ErrorKind::wrong_usage, fmt::format("--left lists {} pictures and --right {}, expected as many",
                                                    arguments.left.size(), arguments.right.size()));
  std::vector<PictureFiles> pairs;
  for (std::size_t i = 0; i < arguments.left.size(); ++i) pairs.push_back({arguments.left[i], arguments.right[i]});
  return pairs;
}

Report report_of(const CalibrationResult& result, const CalibrateArguments& arguments) {
  Json pairs = Json::array();
  std::vector<std::string> each;
  for (const CalibrationPair& pair : result.pairs) {
    pairs.push_back({{"left", pair.left_name},
                     {"right", pair.right_name},
                     {"used", pair.used},
                     {"why_not", pair.why_not},
                     {"left_error_px", pair.left_error_px},
                     {"right_error_px", pair.right_error_px}});
    each.push_back(fmt::format("{}, {}: ", pair.left_name, pair.right_name) +
                   (pair.used ? fmt::format("{:.3f} and {:.3f} px", pair.left_error_px, pair.right_error_px)
                              : fmt::format("left out: {}", pair.why_not)));
  }
  const auto used = std::ranges::count_if(result.pairs, &CalibrationPair::used);
  const auto& [x, y, z] = result.calibration.translation;
  const double error_px = result.calibration.reprojection_error_px, baseline_mm = std::hypot(x, y, z);
  const bool swapped = eyes_swapped(result.calibration);
  return {
      {{"file", arguments.output},
       {"pairs", pairs, lines({}, each)},
       only_text(fmt::format("used                  {} of {} pairs", used, result.pairs.size())),
       {"reprojection_error_px", error_px, fmt::format("reprojection error    {:.3f} px", error_px)},
       {"row_difference_px", result.row_difference_px,
        fmt::format("rows differ           {:.3f} px after rectification, median of the corners",
                    result.row_difference_px)},
       {"baseline_mm", baseline_mm, fmt::format("eye separation        {:.2f} mm", baseline_mm)},
       {"eyes_swapped", swapped,
        swapped
            ? "note                  the left pictures are those of the camera on the right: left and right are swapped"
            : ""},
       only_text(fmt::format("written to            {}", arguments.output))}};
}

Report run_calibrate(const CalibrateArguments& arguments, const Session& session) {
  const Checkerboard board{arguments.board.width, arguments.board.height, arguments.square_mm};
  const std::vector<PictureFiles> files = files_from(arguments);
  for (const PictureFiles& pair : files)
    check_not_an_input(arguments.output, std::array<fs::path, 2>{pair.left, pair.right});
  const std::vector<BoardSighting> sightings = find_checkerboards(files, board, session.progress);
  const CalibrationResult result = calibrate(sightings, board, {}, session.progress);
  write_stereo_calibration(arguments.output, result.calibration);
  return report_of(result, arguments);
}

Rows calibrate_rows(CalibrateArguments& a) {
  return {row("DIR", text(a.folder), "Folder with left_*.png and right_*.png, or another picture format"),
          row("--left", texts(a.left), "Left pictures, instead of a folder"),
          row("--right", texts(a.right), "Right pictures, in the same order"),
          row("--board", size(a.board, {3, 200}, "inner corners COLUMNSxROWS"),
              "Inner corners of the checkerboard: COLUMNSxROWS"),
          row("--square", length(a.square_mm, {0.01, 10'000}), "Side of a square, in mm or with a unit: 3cm, 1.2in"),
          row("-o,--output", output_name(a.output), "Calibration file, in the format of OpenCV's FileStorage")};
}

}  // namespace

Command calibrate_command() {
  return make_command(
      "calibrate", "Calibrate the cameras of a stereo rig from photographs of a checkerboard", calibrate_rows,
      run_calibrate,
      R"(At least 3 pairs must show the whole checkerboard; a dozen, tilted in several directions, are better. Pairs
without it and outliers are left out and named.

Example:
  wheatstone calibrate rig --board 11x7 --square 30mm -o calibration.yml
  wheatstone rectify left.png right.png --calibration calibration.yml -o rectified)");
}

}  // namespace wheatstone::cli
