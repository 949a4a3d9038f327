#include "paint_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>

#include "device_option.h"
#include "option_use.h"
#include "output_option.h"
#include "picture_format.h"
#include "typed_options.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/style_parameters.h"
#include "wheatstone/photograph/carried_depth.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

/// Whether a file's name says that it holds both views.
bool is_stereo_name(const std::string& file) {
  constexpr std::array endings{".mpo", ".jps", ".pns"};
  std::string ending = fs::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(endings, ending) != endings.end();
}

bool are_left_and_right(const PaintArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  if (files.size() != 2 || !arguments.photographs.layout.empty()) return false;
  const bool first = is_stereo_name(files[0]), second = is_stereo_name(files[1]);
  if (first != second)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("{} holds both views and {} is one picture, expected LEFT and RIGHT, or files that hold both "
                    "views each (--layout says so of pictures)",
                    files[first ? 0 : 1], files[first ? 1 : 0]));
  return !first;
}

void add_display_options(CLI::App& command, PaintArguments& arguments) {
  std::string names;
  for (const DisplayPreset& preset : display_presets()) names += fmt::format(" {}", preset.name);
  auto* display = command.add_option("--display", arguments.display,
                                     "Paint the views of a display, as one quilt where the display takes one:" + names);
  add_number(command, "--views", arguments.views, view_count_range, "Number of views; the display's own by default")
      ->default_str("")
      ->needs(display);
  command.add_option("--size", arguments.size, "Size of a view, WIDTHxHEIGHT; the display's own by default")
      ->needs(display);
  add_number(command, "--span", arguments.span, {0.01, view_span_range.most},
             "Distance from the first view to the last, in eye separations; chosen from the depth by default")
      ->default_str("")
      ->needs(display);
}

void add_depth_mapping_options(CLI::App& command, PaintArguments& arguments) {
  auto* mapping =
      command
          .add_option(
              "--depth-mapping", arguments.depth_mapping,
              "Depth at several points, SHARE:MM,SHARE:MM,...: SHARE is from 0, the nearest disparity, to 1, the "
              "farthest, and MM is the depth behind the screen")
          ->excludes("--zero-parallax", "--zero-parallax-at", "--depth-budget");
  add_number(command, "--distance", arguments.distance_mm, {1, 1e6},
             "Viewing distance of a depth mapping, in mm; the display's by default, 700 without one")
      ->default_str("")
      ->needs(mapping);
  add_number(command, "--screen-width", arguments.screen_width_mm, {1, 1e6},
             "Width of the screen of a depth mapping, in mm; the display's by default, 376 without one")
      ->default_str("")
      ->needs(mapping);
}

}  // namespace

void add_paint_options(CLI::App& command, PaintArguments& arguments) {
  command.add_option("PHOTOGRAPHS", arguments.files,
                     "LEFT and RIGHT photograph; or files that hold both views each: MPO, JPS, side by side, one above "
                     "the other; or one picture with --depth; or one painting.wst, which is drawn again");
  add_output_option(command, arguments.folder, "Folder for the results");
  add_picture_format(command, arguments.format, "File format of the painted pictures; masks and disparities are PNG");
  command.add_option("--print-style", arguments.print_style, "Print a style as a style file (.toml) and exit");
  command.add_option(
      "--disparity", arguments.disparity,
      "Disparity of the left view, which replaces matching: PNG, PFM or EXR as FILE[:SCALE], value / SCALE = pixels");
  command.add_option("--right-disparity", arguments.right_disparity, "Disparity of the right view, in the same form");
  auto* plane = command.add_option("--zero-parallax", arguments.zero_parallax,
                                   "Disparity in pixels that lies on the screen plane, or 'nearest'");
  plane->capture_default_str();
  command
      .add_option("--zero-parallax-at", arguments.zero_parallax_at,
                  "Pixel X,Y of the left photograph that lies on the screen plane")
      ->excludes(plane);
  command
      .add_option(
          "--depth-budget", arguments.depth_budget,
          "Depth of side_by_side and anaglyph from the farthest point to the nearest, at most, in % of the width; "
          "'full' for that of the photographs. The pictures are drawn for eyes that are nearer together")
      ->type_name("SHARE")
      ->capture_default_str();
  add_depth_mapping_options(command, arguments);
  add_number(command, "--scale", arguments.scale, {0.01, 32}, "Scale factor of a painting.wst that is drawn again");
  add_display_options(command, arguments);
  add_device_option(command, arguments.device, "What draws the planned pictures");
  command.add_flag("--report", arguments.measure, "Measure the consistency of the two painted views");
  command.add_flag("--svg", arguments.svg, "Also write left.svg and right.svg, the marks as vector graphics");
  command.add_flag("--html", arguments.html, "Also write index.html, which shows the pictures");
  add_stereo_options(command, arguments.photographs);
  add_rectify_option(command, arguments.photographs.rectify);
  add_depth_options(command, arguments.depth);
  add_style_options(command, arguments.style);
  add_match_options(command, arguments.matching);
}

void refuse_for_printing(const CLI::App& command) {
  std::vector<std::string> kept{"--print-style"};
  for (const StyleParameter& parameter : style_parameters()) kept.push_back(fmt::format("--{}", parameter.name));
  refuse_all_but(command, kept, "with --print-style", "nothing is painted");
}

void refuse_for_painting_file(const CLI::App& command, const PaintArguments& arguments) {
  if (arguments.display.empty()) {
    refuse_all_but(command,
                   {"--output", "--format", "--scale", "--svg", "--device", "--zero-parallax", "--depth-budget",
                    "--depth-mapping", "--distance", "--screen-width"},
                   "on a painting (.wst)", "it works on photographs");
    return;
  }
  refuse_options(command, {"--scale", "--svg", "--depth-budget"}, "with --display",
                 "it works where two eyes are drawn");
  refuse_all_but(command,
                 {"--output", "--format", "--device", "--display", "--views", "--size", "--span", "--zero-parallax",
                  "--depth-mapping", "--distance", "--screen-width"},
                 "on a painting (.wst)", "it works on photographs");
  if (arguments.zero_parallax == "nearest")
    refuse_options(command, {"--zero-parallax"}, "as 'nearest' with --display", "it works with a disparity in pixels");
}

namespace {

void refuse_for_depth(const CLI::App& command, const PaintArguments& arguments) {
  const std::string option = arguments.depth.model.empty() ? "--depth" : "--depth-model";
  const bool is_given = !arguments.depth.file.empty() || !arguments.depth.model.empty();
  if (!is_given)
    refuse_group(command, depth_options_group, {arguments.depth.carried ? "--strength" : ""}, "without --depth", "");
  if (!is_given && !arguments.depth.carried) return;
  if (is_given && arguments.files.size() > 1)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: belongs to one picture, but {} files are given; where there are two views, "
                            "--disparity gives that of the left one",
                            option, arguments.files.size()));
  if (!arguments.depth.model.empty())
    refuse_options(command, {"--depth-is"}, "with --depth-model", "a network gives inverse depth");
  const std::string situation = is_given ? "with " + option : "on a picture that has its own depth";
  refuse_options(command, {"--disparity", "--right-disparity", "--swap", "--rectify"}, situation,
                 "it works where there are two views");
  if (is_given) refuse_options(command, {"--layout"}, situation, "it works where one file holds both");
  refuse_match_options_without_effect(command, arguments.matching, situation);
}

}  // namespace

void refuse_for_photographs(const CLI::App& command, const PaintArguments& arguments, bool several) {
  refuse_options(command, {"--scale"}, "on photographs", "it works on a painting (.wst)");
  refuse_for_depth(command, arguments);
  if (several)
    refuse_options(command, {"--disparity", "--right-disparity", "--zero-parallax-at"}, "on several photographs",
                   "it belongs to one");
  if (!arguments.disparity.empty())
    refuse_options(command, {"--max-size"}, "with --disparity", "the disparity belongs to the whole picture");
  refuse_match_options_without_effect(command, arguments.matching,
                                      arguments.disparity.empty() ? "" : "with --disparity");
  if (arguments.display.empty()) return;
  refuse_options(command, {"--report", "--html", "--svg", "--depth-budget"}, "with --display",
                 "it works where two eyes are painted");
  if (arguments.zero_parallax == "nearest")
    refuse_options(command, {"--zero-parallax"}, "as 'nearest' with --display", "it works with a disparity in pixels");
}

void refuse_for_flat(const PaintArguments& arguments, const std::string& picture) {
  const auto refuse = [&](bool given, std::string_view option) {
    if (given)
      throw Error(
          ErrorKind::wrong_usage,
          fmt::format("{}: has no effect on {}, one picture without depth, which is painted flat; --depth gives "
                      "it depth",
                      option, picture));
  };
  refuse(arguments.measure, "--report");
  refuse(arguments.html, "--html");
  refuse(arguments.photographs.rectify == RectifyPolicy::always, "--rectify always");
  refuse(arguments.zero_parallax != "nearest", "--zero-parallax");
  refuse(!arguments.zero_parallax_at.empty(), "--zero-parallax-at");
  refuse(!arguments.depth_mapping.empty(), "--depth-mapping");
  refuse(!arguments.display.empty(), "--display");
}

std::optional<float> depth_budget_from(const PaintArguments& arguments) {
  if (arguments.depth_budget == "full") return {};
  return parse_share("--depth-budget", arguments.depth_budget, {0.1, 100});
}

DepthPlacing depth_placing_from(const PaintArguments& arguments) {
  DepthPlacing placing;
  if (!arguments.depth_mapping.empty())
    placing.regions = parse_depth_regions(arguments.depth_mapping, "--depth-mapping");
  if (!arguments.display.empty()) placing.viewing = viewing_of(find_display(arguments.display));
  if (arguments.distance_mm > 0) placing.viewing.viewing_distance_mm = arguments.distance_mm;
  if (arguments.screen_width_mm > 0) placing.viewing.screen_width_mm = arguments.screen_width_mm;
  for (const DepthRegion& region : placing.regions)
    if (!(region.behind_mm > -placing.viewing.viewing_distance_mm))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--depth-mapping: has {:.0f} mm, which is behind the viewer, who is {:.0f} mm away",
                              region.behind_mm, placing.viewing.viewing_distance_mm));
  return placing;
}

bool finds_depth_in_file(const CLI::App& command, const PaintArguments& arguments) {
  if (arguments.files.size() != 1 || !arguments.depth.file.empty() || !arguments.depth.model.empty()) return false;
  if (arguments.photographs.layout == depth_layout) return true;
  // Whoever says where two views lie, or what disparity they have, is believed.
  for (const char* option : {"--layout", "--swap", "--disparity"})
    if (was_given(command, option)) return false;
  return !is_stereo_name(arguments.files.front()) && carries_depth(arguments.files.front());
}

std::vector<PaintJob> paint_jobs(const PaintArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  if (files.empty())
    throw Error(ErrorKind::wrong_usage,
                "paint: no photographs, expected two files, LEFT and RIGHT, or one with both views");
  if (are_left_and_right(arguments)) return {{files[0], files[1], arguments.folder}};
  if (files.size() == 1) return {{files[0], {}, arguments.folder}};
  std::vector<PaintJob> jobs;
  std::map<std::string, std::string> file_of;
  for (const std::string& file : files) {
    const std::string stem = fs::path(file).stem().string();
    const auto [known, is_new] = file_of.emplace(stem, file);
    if (!is_new)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: would be painted into the same folder as {}, expected different names", file,
                              known->second));
    jobs.push_back({file, {}, (fs::path(arguments.folder) / stem).string()});
  }
  return jobs;
}

}  // namespace wheatstone::cli
