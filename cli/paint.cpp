#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "command.h"
#include "device_option.h"
#include "disparity_argument.h"
#include "display_argument.h"
#include "number_arguments.h"
#include "paint_arguments.h"
#include "print_facts.h"
#include "views_argument.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/kept_memory_internal.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/marks/style_parameters.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using Arguments = PaintArguments;

ZeroParallax parse_zero_parallax(const Arguments& arguments) {
  constexpr double farthest_px = 65535;
  ZeroParallax wanted;
  if (!arguments.zero_parallax_at.empty()) {
    const std::vector<int> at =
        parse_integers("--zero-parallax-at", arguments.zero_parallax_at, {',', 2, {0, farthest_px}, "X,Y"});
    wanted.at = {at[0], at[1]};
  } else if (arguments.zero_parallax != "nearest") {
    wanted.disparity_px =
        static_cast<float>(parse_number("--zero-parallax", arguments.zero_parallax, {-farthest_px, farthest_px}));
  }
  return wanted;
}

/// What eyes so far apart make of the depth.
std::string less_depth(float separation) {
  const long percent = std::max(std::lround(100 * separation), 1L);
  return percent == 50 ? "halved" : fmt::format("reduced to {} %", percent);
}

std::string summary_of(const PaintingReport& told, std::optional<float> depth_budget) {
  const auto& [result, style, pair, measures, whole] = told;
  std::string text;
  const auto to = std::back_inserter(text);
  const PaintedPair& painted = result.painted;
  const Painting& painting = painted.painting;
  const MarkCount marks = count_marks(painting);
  const std::size_t layers = layers_of(painting).size();
  const std::string in_layers = layers > 0 ? fmt::format(" in {} layers", layers) : "";
  const double seconds = painted.times.planning_s + painted.times.rasterising_s;
  fmt::format_to(to, "painted          {} {}{}, {:.2f} s\n", marks.count, marks.kind, in_layers, seconds);
  if (whole.width > 0)
    fmt::format_to(to, "reduced          from {}x{} to {}x{} pixels\n", whole.width, whole.height, width_of(painting),
                   height_of(painting));
  const bool one_view = painted.pictures.right.empty();
  if (pair != nullptr && !one_view && !undecided_eyes(*pair).empty())
    fmt::format_to(to, "eyes             {}\n", undecided_eyes(*pair));
  if (one_view) {
    fmt::format_to(to, "unpainted        {:.2f} %\n", 100 * painted.left_bare_share);
    return text;
  }
  fmt::format_to(to, "unpainted        {:.2f} % (left), {:.2f} % (right)\n", 100 * painted.left_bare_share,
                 100 * painted.right_bare_share);
  fmt::format_to(to, "zero parallax    disparity {:.1f} px\n", result.zero_parallax_px);
  if (painted.separation < 1)
    fmt::format_to(to,
                   "depth            {} in side_by_side and anaglyph, to stay comfortable ({:.3g} % of width); "
                   "--depth-budget full keeps it\n",
                   less_depth(painted.separation), 100 * *depth_budget);
  if (measures != nullptr) {
    fmt::format_to(to, "left - right     {:.2f} of 255 (photographs {:.2f})\n",
                   measures->painting.difference.mean_absolute, measures->photographs.difference.mean_absolute);
    fmt::format_to(to, "depth lost       {:.1f} % off by over 2 px (photographs {:.1f} %)\n",
                   100 * measures->painting.survival.bad_2, 100 * measures->photographs.survival.bad_2);
  }
  return text;
}

/// Where the results of one photograph go, and all that is read.
ViewsOutput output_of(const Arguments& arguments, const std::string& name) {
  ViewsOutput output{name, {arguments.style.style, arguments.matching.model}, arguments.format};
  output.inputs.insert(output.inputs.end(), arguments.files.begin(), arguments.files.end());
  output.inputs.emplace_back(arguments.depth.file);
  output.inputs.emplace_back(arguments.depth.model);
  for (const std::string& disparity : {arguments.disparity, arguments.right_disparity}) {
    output.inputs.emplace_back(disparity);
    output.inputs.emplace_back(disparity.substr(0, disparity.rfind(':')));  // FILE:SCALE
  }
  return output;
}

/// What a display wants, where the user does not say otherwise.
DisplayViewsOptions views_options(const Arguments& arguments, const DisplayPreset& display) {
  DisplayViewsOptions options =
      display_views_options(display, {arguments.display, arguments.size, arguments.views, arguments.span});
  options.depth = depth_placing_from(arguments);
  options.device = arguments.device;
  return options;
}

/// The quilt or the lenticular picture that the display takes, if it takes one.
std::optional<DisplayComposition> composition_for(const DisplayPreset& display, int views) {
  const QuiltLayout layout{display.quilt_columns, display.quilt_rows};
  if (layout.columns * layout.rows == views) return layout;
  if (display.lenses.screen_width_px > 0) return lenticular_screen_of(display);
  return {};
}

/// Writes the picture that the display takes, and else a picture a view.
std::string write_views(const DisplayPreset& display, const ViewsOutput& output, const DisplayViews& result,
                        const Progress& progress) {
  const std::optional<DisplayComposition>& composition = result.plan.presentation.composition;
  const Presented& shown = result.shown;
  if (composition && std::holds_alternative<QuiltLayout>(*composition))
    return write_quilt(shown.composed, std::get<QuiltLayout>(*composition), display.aspect, output);
  if (composition) return write_lenticular(shown.composed, output);
  write_view_folder(shown.views, output, progress);
  return output.name;
}

/// What is painted: a photograph of two views, or a pair that was made of one picture and its depth.
struct Subject {
  ReadPhotograph photograph;
  std::optional<float> strength;  ///< of the depth, in widths; none: there are two views
  Json told() const {
    if (strength) return {{"strength", *strength}};
    return Json::parse(preparation_json(photograph.pair));
  }
};

bool is_single_picture(const Arguments& arguments) {
  return !arguments.depth.file.empty() || !arguments.depth.model.empty() || arguments.depth.carried;
}

/// Reads what is to be painted; what is known of its geometry goes into the options.
Subject read_subject(const Arguments& arguments, const PaintJob& job, PaintPhotographOptions& options,
                     const Session& session) {
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
  Subject subject{read_photographs(files, !arguments.disparity.empty(), session), {}};
  if (!arguments.disparity.empty()) options.left_disparity = read_disparity_argument(arguments.disparity);
  if (!arguments.right_disparity.empty()) options.right_disparity = read_disparity_argument(arguments.right_disparity);
  return subject;
}

/// What is told of a photograph that was painted.
struct Painted {
  Json facts;
  std::string text;
  std::string written;
};

/// Writes the views of a display.
Painted write_and_tell(const Arguments& arguments, const DisplayPreset& display, const std::string& output,
                       const DisplayViews& drawn, const Session& session) {
  const std::string written = write_views(display, output_of(arguments, output), drawn, session.progress);
  const DisplayPlan& plan = drawn.plan;
  const Placement& placement = plan.presentation.placement;
  const std::size_t views = plan.presentation.views.size();
  Json facts{{"output", written},
             {"views", views},
             {"width", placement.width},
             {"height", placement.height},
             {"span", plan.span},
             {"zero_parallax_px", plan.zero_parallax_px},
             {"worst_bare_share", drawn.shown.worst_bare_share}};
  std::string text =
      fmt::format("painted          {} views of {}x{} pixels, {:.2f} eye separations from first to last\n", views,
                  placement.width, placement.height, plan.span);
  text += fmt::format("zero parallax    disparity {:.1f} px\n", plan.zero_parallax_px);
  text += fmt::format("unpainted        at most {:.2f} % of a view\n", 100 * drawn.shown.worst_bare_share);
  return {std::move(facts), std::move(text), written};
}

Painted paint_for_display(const Arguments& arguments, const PaintJob& job, const Subject& subject,
                          const PaintPhotographOptions& painting, const Session& session) {
  const ReadPhotograph& photograph = subject.photograph;
  const DisplayPreset& display = find_display(arguments.display);
  const DisplayViewsOptions options = views_options(arguments, display);
  const PaintedViews result = paint_views(photograph.pair.pictures, painting, options, session.progress,
                                          composition_for(display, options.views));
  if (result.confidence) tell_of_match(photograph, *result.confidence, session);
  Painted painted = write_and_tell(arguments, display, job.output, result.views, session);
  painted.facts[subject.strength ? "depth" : "pair"] = subject.told();
  if (result.confidence) painted.facts["confidence"] = Json::parse(confidence_json(*result.confidence));
  if (photograph.whole.width > 0)
    painted.facts["reduced_from"] = {{"width", photograph.whole.width}, {"height", photograph.whole.height}};
  return painted;
}

/// What the options say, before anything is read.
PaintPhotographOptions options_from(const Arguments& arguments, const Session& session) {
  PaintPhotographOptions options;
  options.style = style_from(arguments.style, session.seed);
  options.matching = match_options_from(arguments.matching);
  options.zero_parallax = parse_zero_parallax(arguments);
  options.device = arguments.device;
  if (arguments.disparity.empty() && !arguments.right_disparity.empty())
    throw Error(ErrorKind::wrong_usage, "--right-disparity: needs --disparity, that of the left view");
  depth_budget_from(arguments);
  depth_placing_from(arguments);
  if (!arguments.display.empty()) views_options(arguments, find_display(arguments.display));
  return options;
}

Painted paint_one(const Arguments& arguments, const PaintJob& job, PaintPhotographOptions options,
                  const Session& session) {
  keep_freed_memory();
  // What cannot be written is said before the work.
  const ViewsOutput output = output_of(arguments, job.output);
  ResultOptions results{
      .photographs = arguments.photographs.rectify != RectifyPolicy::never || is_single_picture(arguments),
      .html = arguments.html,
      .svg = arguments.svg,
      .format = arguments.format};
  std::optional<OutputFolder> folder;
  if (!arguments.display.empty()) {
    check_views_output(output);
  } else {
    folder.emplace(output.name, output.inputs);
    for (const std::string& name : result_names(results)) folder->file(name);
  }
  const Subject subject = read_subject(arguments, job, options, session);
  const ReadPhotograph& photograph = subject.photograph;
  const StereoPair& pictures = photograph.pair.pictures;
  if (pictures.right.empty()) refuse_for_flat(arguments, photograph.name);
  results.photographs = subject.strength || photograph.pair.rectification;
  if (!arguments.display.empty()) return paint_for_display(arguments, job, subject, options, session);

  const DepthPlacing placing = depth_placing_from(arguments);
  options.depth_budget = placing.regions.empty() ? depth_budget_from(arguments) : std::nullopt;
  PaintedPhotograph result = paint_photograph(pictures, options, session.progress);
  if (result.confidence) tell_of_match(photograph, *result.confidence, session);
  std::optional<PaintingMeasures> measures;
  if (arguments.measure)
    measures = measure_painting(pictures, result, options.left_disparity.value_or(result.geometry.left_disparity),
                                session.progress);
  redraw_with_depth(placing, result);
  const PaintingMeasures* measured = measures ? &*measures : nullptr;
  const PaintingReport told{result, options.style, subject.strength ? nullptr : &photograph.pair, measured,
                            photograph.whole};
  write_results(*folder, pictures, told, results, session.progress);
  return {Json::parse(report_json(told)), summary_of(told, options.depth_budget), job.output};
}

/// Paints each photograph; one that fails does not stop the others.
void paint_all(const Arguments& arguments, const std::vector<PaintJob>& jobs, const PaintPhotographOptions& options,
               const Session& session) {
  const MissingFolders made(arguments.folder);
  if (!fs::is_directory(arguments.folder))
    throw Error(ErrorKind::cannot_read_write, fmt::format("{}: is a file, expected a folder", arguments.folder));
  Json photographs = Json::array();
  std::size_t failed = 0;
  int worst = 0;
  for (const PaintJob& job : jobs) {
    try {
      const Painted painted = paint_one(arguments, job, options, session);
      photographs.push_back({{"file", job.left}, {"output", painted.written}, {"report", painted.facts}});
    } catch (const Error& failure) {
      if (failure.kind() == ErrorKind::interrupted) throw;
      ++failed;
      worst = std::max(worst, static_cast<int>(failure.kind()));
      photographs.push_back(
          {{"file", job.left}, {"error", failure.what()}, {"exit_code", static_cast<int>(failure.kind())}});
    }
  }
  const std::string summary = fmt::format("{} of {} photographs painted", jobs.size() - failed, jobs.size());
  if (session.json) {
    const Json facts{{"painted", jobs.size() - failed}, {"failed", failed}, {"photographs", photographs}};
    print_facts(facts, session);
  } else {
    for (const Json& one : photographs)
      if (one.contains("output"))
        fmt::print(session.output, "{}: written to {}\n", one["file"].get<std::string>(),
                   one["output"].get<std::string>());
    fmt::print(session.output, "{}\n", summary);
  }
  if (failed == 0) return;
  for (const Json& one : photographs)
    if (one.contains("error"))
      fmt::print(session.errors, "wheatstone: {}\n", one_line(one["error"].get<std::string>()));
  throw ErrorTold{worst};
}

void tell(const Painted& painted, const Session& session) {
  if (session.json) {
    print_facts(painted.facts, session);
  } else {
    fmt::print(session.output, "{}written to       {}\n", painted.text, painted.written);
  }
}

void draw_for_display_again(const Arguments& arguments, const Session& session) {
  const ViewsOutput output = output_of(arguments, arguments.folder);
  check_views_output(output);
  const DisplayPreset& display = find_display(arguments.display);
  DisplayViewsOptions options = views_options(arguments, display);
  options.zero_parallax_px = parse_zero_parallax(arguments).disparity_px;
  const DisplayViews views = draw_display_views(read_painting_for_views(arguments.files.front()), options,
                                                session.progress, composition_for(display, options.views));
  tell(write_and_tell(arguments, display, arguments.folder, views, session), session);
}

void draw_painting_again(const Arguments& arguments, const CLI::App& command, const Session& session) {
  refuse_for_painting_file(command, arguments);
  if (!arguments.display.empty()) return draw_for_display_again(arguments, session);
  const RedrawOptions options{.scale = arguments.scale,
                              .svg = arguments.svg,
                              .format = arguments.format,
                              .zero_parallax_px = parse_zero_parallax(arguments).disparity_px,
                              .depth_budget = depth_budget_from(arguments),
                              .depth = depth_placing_from(arguments),
                              .device = arguments.device};
  OutputFolder folder(arguments.folder, output_of(arguments, arguments.folder).inputs);
  draw_again(read_painting(arguments.files.front()), folder, options, session.progress);
  if (session.json) {
    print_facts({{"folder", arguments.folder}}, session);
  } else {
    fmt::print(session.output, "written to       {}\n", arguments.folder);
  }
}

void run_paint(Arguments& arguments, const CLI::App& command, const Session& session) {
  if (!arguments.print_style.empty()) {
    refuse_for_printing(command);
    StyleArguments style = arguments.style;
    style.style = arguments.print_style;
    fmt::print(session.output, "{}", style_to_toml(style_from(style, session.seed)));
    return;
  }
  settle_device(arguments.device, session);
  if (arguments.files.size() == 1 && arguments.files.front().ends_with(".wst"))
    return draw_painting_again(arguments, command, session);
  const std::vector<PaintJob> jobs = paint_jobs(arguments);
  arguments.depth.carried = finds_depth_in_file(command, arguments);
  refuse_for_photographs(command, arguments, jobs.size() > 1);
  const PaintPhotographOptions options = options_from(arguments, session);
  if (jobs.size() > 1) return paint_all(arguments, jobs, options, session);
  tell(paint_one(arguments, jobs.front(), options, session), session);
}

}  // namespace

void add_paint_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *program.add_subcommand("paint", "Paint a stereo photograph, or one picture and its depth");
  add_paint_options(command, *arguments);
  command.footer(
      "Writes left.png and right.png as the photographs lie, side_by_side.png and anaglyph.png for viewing, "
      "painting.wst\n"
      "(the marks), disparity, occlusion, and report.json; where the pair was rectified, or made of one picture and "
      "its\n"
      "depth, also left_photograph.png and right_photograph.png, the pictures that were painted.\n\n"
      "Examples:\n  wheatstone synth still -o still\n"
      "  wheatstone paint still/left.png still/right.png --style impressionist --report -o painted\n"
      "  wheatstone paint one.mpo two.mpo three.mpo -o painted\n"
      "  wheatstone paint photograph.mpo --display looking-glass-portrait -o photograph\n"
      "  wheatstone paint photo.jpg --depth depth.png -o painted");
  command.callback([arguments, &command, &session] { run_paint(*arguments, command, session); });
}

}  // namespace wheatstone::cli
