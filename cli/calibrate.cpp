#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "command.h"
#include "number_arguments.h"
#include "output_option.h"
#include "print_facts.h"
#include "typed_options.h"
#include "wheatstone/calibration/calibration.h"
#include "wheatstone/error.h"
#include "wheatstone/files/input_guard.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

struct CalibrateArguments {
  std::string folder;
  std::vector<std::string> left, right;
  std::string board = "11x7";
  double square_mm = 30;
  std::string output = "calibration.yml";
};

Checkerboard board_from(const CalibrateArguments& arguments) {
  const Size corners = parse_size("--board", arguments.board, {3, 200}, "inner corners COLUMNSxROWS");
  return {corners.width, corners.height, arguments.square_mm};
}

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

void print_json(const CalibrationResult& result, const CalibrateArguments& arguments, const Session& session) {
  nlohmann::ordered_json pairs = nlohmann::ordered_json::array();
  for (const CalibrationPair& pair : result.pairs)
    pairs.push_back({{"left", pair.left_name},
                     {"right", pair.right_name},
                     {"used", pair.used},
                     {"why_not", pair.why_not},
                     {"left_error_px", pair.left_error_px},
                     {"right_error_px", pair.right_error_px}});
  const nlohmann::ordered_json facts{
      {"file", arguments.output},
      {"reprojection_error_px", result.calibration.reprojection_error_px},
      {"row_difference_px", result.row_difference_px},
      {"baseline_mm", std::hypot(result.calibration.translation[0], result.calibration.translation[1],
                                 result.calibration.translation[2])},
      {"eyes_swapped", eyes_swapped(result.calibration)},
      {"pairs", pairs}};
  print_facts(facts, session);
}

void print_summary(const CalibrationResult& result, const CalibrateArguments& arguments, const Session& session) {
  for (const CalibrationPair& pair : result.pairs) {
    const std::string names = fmt::format("{}, {}", pair.left_name, pair.right_name);
    if (pair.used) {
      fmt::print(session.output, "{}: {:.3f} and {:.3f} px\n", names, pair.left_error_px, pair.right_error_px);
    } else {
      fmt::print(session.output, "{}: left out: {}\n", names, pair.why_not);
    }
  }
  const auto used = std::ranges::count_if(result.pairs, &CalibrationPair::used);
  const auto& [x, y, z] = result.calibration.translation;
  fmt::print(session.output, "used                  {} of {} pairs\n", used, result.pairs.size());
  fmt::print(session.output, "reprojection error    {:.3f} px\n", result.calibration.reprojection_error_px);
  fmt::print(session.output, "rows differ           {:.3f} px after rectification, median of the corners\n",
             result.row_difference_px);
  fmt::print(session.output, "eye separation        {:.2f} mm\n", std::hypot(x, y, z));
  if (eyes_swapped(result.calibration))
    fmt::print(session.output,
               "note                  the left pictures are those of the camera on the right: left and right are "
               "swapped\n");
  fmt::print(session.output, "written to            {}\n", arguments.output);
}

void run_calibrate(const CalibrateArguments& arguments, const Session& session) {
  const Checkerboard board = board_from(arguments);
  const std::vector<PictureFiles> files = files_from(arguments);
  for (const PictureFiles& pair : files)
    check_not_an_input(arguments.output, std::array<fs::path, 2>{pair.left, pair.right});
  const std::vector<BoardSighting> sightings = find_checkerboards(files, board, session.progress);
  const CalibrationResult result = calibrate(sightings, board, {}, session.progress);
  write_stereo_calibration(arguments.output, result.calibration);
  if (session.json) {
    print_json(result, arguments, session);
  } else {
    print_summary(result, arguments, session);
  }
}

}  // namespace

void add_calibrate_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<CalibrateArguments>();
  CLI::App& command =
      *program.add_subcommand("calibrate", "Calibrate the cameras of a stereo rig from photographs of a checkerboard");
  command.add_option("DIR", arguments->folder, "Folder with left_*.png and right_*.png, or another picture format");
  command.add_option("--left", arguments->left, "Left pictures, instead of a folder");
  command.add_option("--right", arguments->right, "Right pictures, in the same order");
  command.add_option("--board", arguments->board, "Inner corners of the checkerboard: COLUMNSxROWS")
      ->capture_default_str();
  add_length(command, "--square", arguments->square_mm, {0.01, 10'000},
             "Side of a square, in mm or with a unit: 3cm, 1.2in");
  add_output_option(command, arguments->output, "Calibration file, in the format of OpenCV's FileStorage");
  command.footer(
      "At least 3 pairs must show the whole checkerboard; a dozen, tilted in several directions, are better. Pairs\n"
      "without it and outliers are left out and named.\n\n"
      "Example:\n  wheatstone calibrate rig --board 11x7 --square 30mm -o calibration.yml\n"
      "  wheatstone rectify left.png right.png --calibration calibration.yml -o rectified");
  command.callback([arguments, &session] { run_calibrate(*arguments, session); });
}

}  // namespace wheatstone::cli
