#include "paint_arguments.h"

#include <fmt/format.h>

#include <filesystem>
#include <map>

#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/photograph/carried_depth.h"
#include "wheatstone/photograph/find_layout.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

bool are_left_and_right(const PaintArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  if (files.size() != 2 || !arguments.photographs.layout.empty()) return false;
  const bool first = is_stereo_file_name(files[0]), second = is_stereo_file_name(files[1]);
  if (first != second)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{} holds both views and {} is one picture, expected LEFT and RIGHT, or files that hold "
                            "both views each (--layout says so of pictures)",
                            files[first ? 0 : 1], files[first ? 1 : 0]));
  return !first;
}

/// Renders what is to be painted, with its exact disparities and what only other views show.
PaintSubject read_model_subject(const PaintArguments& arguments, const PhotographJob& job,
                                PaintPhotographOptions& options, const Session& session) {
  ModelPictures made = render_model_argument(job.left, arguments.model, widest_views, session);
  options.left_disparity = std::move(made.left_disparity);
  options.right_disparity = std::move(made.right_disparity);
  options.known = std::move(made.known);
  PaintSubject subject;
  subject.photograph.pair.pictures = std::move(made.pictures);
  subject.photograph.pair.eyes = EyeOrder::as_given;
  subject.photograph.name = job.left;
  return subject;
}

}  // namespace

DepthPlacing depth_placing_from(const PaintArguments& arguments) {
  DepthPlacing placing{.regions = arguments.depth_mapping, .viewing = {}};
  if (!arguments.display.name.empty()) placing.viewing = viewing_of(find_display(arguments.display.name));
  if (arguments.distance_mm > 0) placing.viewing.viewing_distance_mm = arguments.distance_mm;
  if (arguments.screen_width_mm > 0) placing.viewing.screen_width_mm = arguments.screen_width_mm;
  for (const DepthRegion& region : placing.regions)
    if (!(region.behind_mm > -placing.viewing.viewing_distance_mm))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--depth-mapping: has {:.0f} mm, which is behind the viewer, who is {:.0f} mm away",
                              region.behind_mm, placing.viewing.viewing_distance_mm));
  return placing;
}

bool is_painting_file(const PaintArguments& arguments) {
  return arguments.files.size() == 1 && arguments.files.front().ends_with(".wst");
}

bool is_model_file(const PaintArguments& arguments) {
  return arguments.files.size() == 1 && is_of_model({.left = arguments.files.front()});
}

bool is_of_model(const PhotographJob& job) { return job.right.empty() && wheatstone::is_model(job.left); }

bool is_photograph_folder(const PaintArguments& arguments) {
  return arguments.files.size() == 1 && is_folder(arguments.files.front());
}

bool are_several(const PaintArguments& arguments) {
  return is_photograph_folder(arguments) || (arguments.files.size() > 1 && !are_left_and_right(arguments));
}

bool finds_depth_in_file(const PaintArguments& arguments) {
  if (arguments.files.size() != 1 || is_photograph_folder(arguments) || is_model_file(arguments) ||
      has_depth(arguments.depth))
    return false;
  if (arguments.photographs.layout == depth_layout) return true;
  // Whoever says where two views lie, or what disparity they have, is believed.
  for (const char* option : {"--layout", "--swap", "--disparity"})
    if (arguments.given(option)) return false;
  return !is_stereo_file_name(arguments.files.front()) && carries_depth(arguments.files.front());
}

bool is_single_picture(const PaintArguments& arguments) {
  return has_depth(arguments.depth) || arguments.depth.carried;
}

PaintSubject read_subject(const PaintArguments& arguments, const PhotographJob& job, PaintPhotographOptions& options,
                          const Session& session) {
  if (is_of_model(job)) return read_model_subject(arguments, job, options, session);
  StereoArguments files = arguments.photographs;
  files.left = job.left;
  files.right = job.right;
  files.may_be_flat = arguments.disparity.empty();
  if (is_single_picture(arguments)) {
    SinglePicture single = read_single_picture(files, arguments.depth, session);
    options.left_disparity = std::move(single.pair.geometry.left_disparity);
    options.right_disparity = std::move(single.pair.geometry.right_disparity);
    return {{{.pictures = std::move(single.pair.pictures)}, single.whole}, single.strength};
  }
  PaintSubject subject{read_photographs(files, !arguments.disparity.empty(), session), {}};
  if (!arguments.disparity.empty()) options.left_disparity = read_disparity_argument(arguments.disparity);
  if (!arguments.right_disparity.empty()) options.right_disparity = read_disparity_argument(arguments.right_disparity);
  return subject;
}

std::vector<PhotographJob> paint_jobs(const PaintArguments& arguments) {
  const std::vector<std::string>& files = arguments.files;
  if (files.empty())
    throw Error(ErrorKind::wrong_usage,
                "paint: no photographs, expected two files, LEFT and RIGHT, or one with both views");
  if (are_left_and_right(arguments)) return {{files[0], files[1], arguments.folder}};
  if (files.size() == 1) return {{files[0], {}, arguments.folder}};
  std::vector<PhotographJob> jobs;
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

std::optional<fs::path> painted_picture(const PhotographJob& job, const std::string& format) {
  for (const char* name : {"left", "painted"}) {
    const fs::path file = fs::path(job.output) / fmt::format("{}.{}", name, format);
    if (fs::exists(file)) return file;
  }
  return {};
}

PhotographList photographs_to_paint(const PaintArguments& arguments, const Session& session) {
  const std::string style = fs::path(arguments.style.style).stem().string();
  return photographs_in_folder(arguments.files.front(), arguments.photographs, arguments.walk,
                               {.folder = arguments.folder, .ending = {}, .placeholders = {{"style", style}}}, session);
}

std::vector<PhotographJob> a_job_for_each_style(const PaintArguments& arguments) {
  std::vector<PhotographJob> jobs;
  for (const std::string_view style : style_names()) {
    jobs.push_back(paint_jobs(arguments).front());
    jobs.back().output = (fs::path(arguments.folder) / style).string();
  }
  return jobs;
}

}  // namespace wheatstone::cli
