#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "depth_argument.h"
#include "match_options.h"
#include "stereo_arguments.h"
#include "style_options.h"
#include "wheatstone/gpu/device.h"
#include "wheatstone/marks/mapped_depth.h"

namespace wheatstone::cli {

/// What `paint` is told, as it is typed.
struct PaintArguments {
  std::vector<std::string> files;
  StereoArguments photographs;  ///< how each is read; the files are those of one
  std::string folder = "painted";
  std::string format = "png";
  std::string print_style;
  std::string disparity, right_disparity;
  DepthArguments depth;
  std::string zero_parallax = "nearest";
  std::string zero_parallax_at;
  std::string depth_budget = "3%";
  std::string depth_mapping;
  float distance_mm = 0, screen_width_mm = 0;  ///< of a depth mapping's viewer; 0: the display's, or a desk's
  double scale = 1;
  std::string display, size;
  int views = 0;
  float span = 0;
  Device device = Device::processor;
  bool measure = false;
  bool html = false;
  bool svg = false;
  MatchArguments matching;
  StyleArguments style;
};

void add_paint_options(CLI::App& command, PaintArguments& arguments);

// Each throws Error{wrong_usage} for an option that has no effect in this kind of run.
void refuse_for_printing(const CLI::App& command);
void refuse_for_painting_file(const CLI::App& command, const PaintArguments& arguments);
void refuse_for_photographs(const CLI::App& command, const PaintArguments& arguments, bool several);

/// Throws Error{wrong_usage} for an option that has no effect on `picture`, one picture without depth.
void refuse_for_flat(const PaintArguments& arguments, const std::string& picture);

/// Of what is looked at, as a share of the width; none: "full".
std::optional<float> depth_budget_from(const PaintArguments& arguments);

/// Where a viewer is to see the scene's parts. Throws Error{wrong_usage}.
DepthPlacing depth_placing_from(const PaintArguments& arguments);

/// Whether the one file that is given is one picture that has its own depth, which is painted.
bool finds_depth_in_file(const CLI::App& command, const PaintArguments& arguments);

/// One photograph and where its painting goes.
struct PaintJob {
  std::string left, right;  ///< right is empty where left holds both views, or is one picture with its depth
  std::string output;
};

/// Tells which files are photographs of their own. One file holds both views. Two files are LEFT and RIGHT, unless both
/// are named as stereo photographs (.mpo, .jps, .pns) or --layout says that each holds both views; three or more hold
/// both views each. Several are painted into folders named for them inside the output.
/// Throws Error{wrong_usage} where that is ambiguous, or two would get one folder.
std::vector<PaintJob> paint_jobs(const PaintArguments& arguments);

}  // namespace wheatstone::cli
