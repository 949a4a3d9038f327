#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "depth_argument.h"
#include "display_argument.h"
#include "match_options.h"
#include "model_argument.h"
#include "options.h"
#include "photograph_folder.h"
#include "stereo_arguments.h"
#include "style_options.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/marks/mapped_depth.h"
#include "wheatstone/marks/slicing.h"

namespace wheatstone::cli {

/// What `paint` is told.
struct PaintArguments {
  Given given;
  std::vector<std::string> files;
  StereoArguments photographs;  ///< how each is read; the files are those of one
  std::string folder = "painted";
  FolderArguments walk;        ///< of a folder
  bool keep_location = false;  ///< whether results say where the photograph was taken
  ResultOptions results;
  std::string print_style;
  std::string disparity, right_disparity;
  std::string detail_map;
  DepthArguments depth;
  PaintPhotographOptions painting;  ///< without the style, the matching and the disparities
  std::vector<DepthRegion> depth_mapping;
  float distance_mm = 0, screen_width_mm = 0;  ///< of a depth mapping's viewer; 0: the display's, or a desk's
  double scale = 1;
  Slicing slicing;  ///< of a painting that is drawn again
  DisplayArguments display;
  ModelArguments model;
  bool measure = false;
  MatchArguments matching;
  StyleArguments style;
};

/// Where a viewer is to see the scene's parts. Throws Error{wrong_usage}.
DepthPlacing depth_placing_from(const PaintArguments& arguments);

/// Whether the one file that is given is a painting, which is drawn again.
bool is_painting_file(const PaintArguments& arguments);

/// Whether the one file that is given is a model of triangles.
bool is_model_file(const PaintArguments& arguments);

/// Whether the one input is a folder of photographs.
bool is_photograph_folder(const PaintArguments& arguments);

/// Whether there are several photographs.
bool are_several(const PaintArguments& arguments);

/// Whether the one file that is given is one picture that has its own depth, which is painted.
bool finds_depth_in_file(const PaintArguments& arguments);

/// Whether it is a model of triangles.
bool is_of_model(const PhotographJob& job);

/// Tells which files are photographs of their own. One file holds both views. Two files are LEFT and RIGHT, unless both
/// are named as stereo photographs (.mpo, .jps, .pns) or --layout says that each holds both views; three or more hold
/// both views each. Several are painted into folders named for them inside the output.
/// Throws Error{wrong_usage} where that is ambiguous, or two would get one folder.
std::vector<PhotographJob> paint_jobs(const PaintArguments& arguments);

/// The photographs in the folder that is given. Throws as photographs_in_folder does.
PhotographList photographs_to_paint(const PaintArguments& arguments, const Session& session);

/// The one photograph that is given, once for each preset of a style, each with a folder of its name.
std::vector<PhotographJob> a_job_for_each_style(const PaintArguments& arguments);

/// What is painted: a photograph of two views, or a pair that was made of one picture and its depth.
struct PaintSubject {
  ReadPhotograph photograph;
  std::optional<float> strength;  ///< of the depth, in widths; none: there are two views
  Json told() const {
    if (strength) return {{"strength", *strength}};
    return Json::parse(preparation_json(photograph.pair));
  }
};

/// Whether it is one picture with its depth.
bool is_single_picture(const PaintArguments& arguments);

/// Reads what is to be painted, or renders it where it is a model; what is known of its geometry goes into the options.
PaintSubject read_subject(const PaintArguments& arguments, const PhotographJob& job, PaintPhotographOptions& options,
                          const Session& session);

/// The painted picture of a job, of the left eye where there are two; none where it was not painted.
std::optional<std::filesystem::path> painted_picture(const PhotographJob& job, const std::string& format);

}  // namespace wheatstone::cli
