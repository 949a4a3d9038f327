#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "device_option.h"
#include "display_argument.h"
#include "paint_arguments.h"
#include "photograph_run.h"
#include "slicing_options.h"
#include "views_argument.h"
#include "wheatstone/app/detail_map.h"
#include "wheatstone/app/model_pictures.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/kept_memory_internal.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/photograph/photograph_notes.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;
using Arguments = PaintArguments;

/// What eyes so far apart make of the depth.
std::string less_depth(float separation) {
  const long percent = std::max(std::lround(100 * separation), 1L);
  return percent == 50 ? "halved" : fmt::format("reduced to {} %", percent);
}

void add_summary(Report& report, const PaintingReport& told, std::optional<float> depth_budget) {
  const auto& [result, style, pair, measures, whole] = told;
  const auto add = [&](std::string line) { report.facts.push_back(only_text(std::move(line))); };
  const PaintedPair& painted = result.painted;
  const Painting& painting = painted.painting;
  const MarkCount marks = count_marks(painting);
  const std::size_t layers = layers_of(painting).size();
  const std::string in_layers = layers > 0 ? fmt::format(" in {} layers", layers) : "";
  const double seconds = painted.times.planning_s + painted.times.rasterising_s;
  add(fmt::format("painted          {} {}{}, {:.2f} s", marks.count, marks.kind, in_layers, seconds));
  if (whole.width > 0)
    add(fmt::format("reduced          from {}x{} to {}x{} pixels", whole.width, whole.height, width_of(painting),
                    height_of(painting)));
  const bool one_view = painted.pictures.right.empty();
  if (pair != nullptr && !one_view && !undecided_eyes(*pair).empty())
    add(fmt::format("eyes             {}", undecided_eyes(*pair)));
  if (one_view) return add(fmt::format("unpainted        {:.2f} %", 100 * painted.left_bare_share));
  add(fmt::format("unpainted        {:.2f} % (left), {:.2f} % (right)", 100 * painted.left_bare_share,
                  100 * painted.right_bare_share));
  add(fmt::format("zero parallax    disparity {:.1f} px", result.zero_parallax_px));
  if (painted.separation < 1)
    add(
        fmt::format("depth            {} in side_by_side and anaglyph, to stay comfortable ({:.3g} % of width); "
                    "--depth-budget full keeps it",
                    less_depth(painted.separation), 100 * *depth_budget));
  if (measures == nullptr) return;
  add(fmt::format("left - right     {:.2f} of 255 (photographs {:.2f})", measures->painting.difference.mean_absolute,
                  measures->photographs.difference.mean_absolute));
  add(fmt::format("depth lost       {:.1f} % off by over 2 px (photographs {:.1f} %)",
                  100 * measures->painting.survival.bad_2, 100 * measures->photographs.survival.bad_2));
}

/// Where the results of one photograph go, and all that is read.
ViewsOutput output_of(const Arguments& arguments, const std::string& name) {
  ViewsOutput output{name, {arguments.style.style, arguments.matching.model}, arguments.results.format};
  output.notes = arguments.results.notes;
  output.inputs.insert(output.inputs.end(), arguments.files.begin(), arguments.files.end());
  output.inputs.emplace_back(arguments.depth.file);
  output.inputs.emplace_back(arguments.detail_map);
  output.inputs.emplace_back(arguments.depth.model);
  output.inputs.push_back(arguments.model.model.choice.texture);
  for (const std::string& disparity : {arguments.disparity, arguments.right_disparity}) {
    output.inputs.emplace_back(disparity);
    output.inputs.emplace_back(disparity.substr(0, disparity.rfind(':')));  // FILE:SCALE
  }
  return output;
}

/// What a display wants, where the user does not say otherwise.
DisplayViewsOptions views_options(const Arguments& arguments, const DisplayPreset& display) {
  DisplayViewsOptions options = display_views_options(display, arguments.display);
  options.depth = depth_placing_from(arguments);
  options.device = arguments.painting.device;
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

bool is_single_picture(const Arguments& arguments) { return has_depth(arguments.depth) || arguments.depth.carried; }

/// Renders what is to be painted, with its exact disparities and what only other views show.
Subject read_model_subject(const Arguments& arguments, const PhotographJob& job, PaintPhotographOptions& options,
                           const Session& session) {
  RenderParticlesOptions seen = arguments.model;
  seen.width = arguments.model_size.width;
  seen.height = arguments.model_size.height;
  const ReadyModel model = ready_model(job.left, seen, session.progress);
  ModelPictures made = model_pictures(model, seen, widest_views, session.progress);
  options.left_disparity = std::move(made.left_disparity);
  options.right_disparity = std::move(made.right_disparity);
  options.known = std::move(made.known);
  Subject subject;
  subject.photograph.pair.pictures = std::move(made.pictures);
  subject.photograph.pair.eyes = EyeOrder::as_given;
  subject.photograph.name = job.left;
  return subject;
}

/// Reads what is to be painted; what is known of its geometry goes into the options.
Subject read_subject(const Arguments& arguments, const PhotographJob& job, PaintPhotographOptions& options,
                     const Session& session) {
  if (is_model(job)) return read_model_subject(arguments, job, options, session);
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

PhotographResult with_place(Report report, std::string written) {
  report.facts.push_back(only_text(fmt::format("written to       {}", written)));
  return {std::move(report), std::move(written)};
}

/// Writes the views of a display.
PhotographResult write_and_tell(const Arguments& arguments, const DisplayPreset& display, const std::string& output,
                                const DisplayViews& drawn, const Session& session) {
  const std::string written = write_views(display, output_of(arguments, output), drawn, session.progress);
  const DisplayPlan& plan = drawn.plan;
  const Placement& placement = plan.presentation.placement;
  const std::size_t views = plan.presentation.views.size();
  const double worst = drawn.shown.worst_bare_share;
  Report report{{{"output", written},
                 {"views", views,
                  fmt::format("painted          {} views of {}x{} pixels, {:.2f} eye separations from first to last",
                              views, placement.width, placement.height, plan.span)},
                 {"width", placement.width},
                 {"height", placement.height},
                 {"span", plan.span},
                 {"zero_parallax_px", plan.zero_parallax_px,
                  fmt::format("zero parallax    disparity {:.1f} px", plan.zero_parallax_px)},
                 {"worst_bare_share", worst, fmt::format("unpainted        at most {:.2f} % of a view", 100 * worst)}}};
  return with_place(std::move(report), written);
}

PhotographResult paint_for_display(const Arguments& arguments, const PhotographJob& job, const Subject& subject,
                                   const PaintPhotographOptions& painting, const Session& session) {
  const ReadPhotograph& photograph = subject.photograph;
  const DisplayPreset& display = find_display(arguments.display.name);
  const DisplayViewsOptions options = views_options(arguments, display);
  const PaintedViews result = paint_views(photograph.pair.pictures, painting, options, session.progress,
                                          composition_for(display, options.views));
  if (result.confidence) tell_of_match(photograph, *result.confidence, session);
  PhotographResult painted = write_and_tell(arguments, display, job.output, result.views, session);
  std::vector<Fact>& facts = painted.report.facts;
  facts.push_back({subject.strength ? "depth" : "pair", subject.told()});
  if (result.confidence) facts.push_back({"confidence", Json::parse(confidence_json(*result.confidence))});
  if (photograph.whole.width > 0)
    facts.push_back({"reduced_from", {{"width", photograph.whole.width}, {"height", photograph.whole.height}}});
  return painted;
}

/// What the options say, before anything is read.
PaintPhotographOptions options_from(const Arguments& arguments, const Session& session) {
  PaintPhotographOptions options = arguments.painting;
  options.style = style_from(arguments.style, session.seed);
  options.matching = match_options_from(arguments.matching);
  if (!arguments.detail_map.empty()) {
    check_reads_detail(options.style);
    options.detail = read_detail_map(arguments.detail_map);
  }
  depth_placing_from(arguments);
  if (!arguments.display.name.empty()) views_options(arguments, find_display(arguments.display.name));
  return options;
}

/// Refuses options of two views for `picture`, which is one without depth.
void refuse_for_flat(const Arguments& arguments, const std::string& picture) {
  const std::string words =
      fmt::format("on {}, one picture without depth, which is painted flat; --depth gives it depth", picture);
  if (arguments.photographs.rectify == RectifyPolicy::always)
    throw Error(ErrorKind::wrong_usage, fmt::format("--rectify always: has no effect {}", words));
  const auto refuse = [&](std::initializer_list<std::string_view> options) {
    refuse_options(arguments.given, options, words);
  };
  refuse({"--report", "--html", "--zero-parallax-at", "--depth-mapping", "--display"});
  if (arguments.painting.zero_parallax.disparity_px) refuse({"--zero-parallax"});
}

PhotographResult paint_one(const Arguments& arguments, const PhotographJob& job, PaintPhotographOptions options,
                           const Session& session) {
  keep_freed_memory();
  // What cannot be written is said before the work.
  const ViewsOutput output = output_of(arguments, job.output);
  ResultOptions results = arguments.results;
  results.photographs =
      arguments.photographs.rectify != RectifyPolicy::never || is_single_picture(arguments) || is_model(job);
  std::optional<OutputFolder> folder;
  if (!arguments.display.name.empty()) {
    check_views_output(output);
  } else {
    folder.emplace(output.name, output.inputs);
    for (const std::string& name : result_names(results)) folder->file(name);
  }
  const Subject subject = read_subject(arguments, job, options, session);
  const ReadPhotograph& photograph = subject.photograph;
  const StereoPair& pictures = photograph.pair.pictures;
  if (pictures.right.empty()) refuse_for_flat(arguments, photograph.name);
  results.photographs = subject.strength || photograph.pair.rectification || is_model(job);
  if (!arguments.display.name.empty()) return paint_for_display(arguments, job, subject, options, session);

  const DepthPlacing placing = depth_placing_from(arguments);
  options.depth_budget = placing.regions.empty() ? arguments.painting.depth_budget : std::nullopt;
  PaintedPhotograph result = paint_photograph(pictures, options, session.progress);
  if (result.confidence) tell_of_match(photograph, *result.confidence, session);
  std::optional<PaintingMeasures> measures;
  if (arguments.measure)
    measures = measure_painting(pictures, result, options.left_disparity.value_or(result.geometry.left_disparity),
                                session.progress);
  redraw_with_depth(placing, result);
  const PaintingMeasures* measured = measures ? &*measures : nullptr;
  const bool is_photograph = !subject.strength && !is_model(job);
  const PaintingReport told{result, options.style, is_photograph ? &photograph.pair : nullptr, measured,
                            photograph.whole};
  write_results(*folder, pictures, told, results, session.progress);
  Report report;
  add_members(report, Json::parse(report_json(told)));
  add_summary(report, told, options.depth_budget);
  return with_place(std::move(report), job.output);
}

/// The arguments of one photograph of those that are given.
Arguments arguments_of(const Arguments& given, const PhotographJob& job) {
  Arguments of_one = given;
  of_one.files = {job.left};
  if (!job.depth.empty()) of_one.depth.file = job.depth;
  of_one.depth.carried = job.right.empty() && finds_depth_in_file(of_one);
  // A layout is that of files that hold both views.
  if (!job.right.empty() || has_depth(of_one.depth)) of_one.photographs.layout.clear();
  if (!is_model(job)) of_one.results.notes = read_photograph_notes(job.left, given.keep_location);
  of_one.files = given.files;
  of_one.files.insert(of_one.files.end(), {job.left, job.right, job.depth});
  return of_one;
}

Report draw_for_display_again(const Arguments& arguments, const Session& session) {
  check_views_output(output_of(arguments, arguments.folder));
  const DisplayPreset& display = find_display(arguments.display.name);
  DisplayViewsOptions options = views_options(arguments, display);
  options.zero_parallax_px = arguments.painting.zero_parallax.disparity_px;
  const DisplayViews views =
      draw_display_views(sliced(read_painting_for_views(arguments.files.front()), arguments.slicing), options,
                         session.progress, composition_for(display, options.views));
  return write_and_tell(arguments, display, arguments.folder, views, session).report;
}

Report draw_painting_again(const Arguments& arguments, const Session& session) {
  if (!arguments.display.name.empty()) return draw_for_display_again(arguments, session);
  const RedrawOptions options{.scale = arguments.scale,
                              .svg = arguments.results.svg,
                              .format = arguments.results.format,
                              .zero_parallax_px = arguments.painting.zero_parallax.disparity_px,
                              .depth_budget = arguments.painting.depth_budget,
                              .depth = depth_placing_from(arguments),
                              .device = arguments.painting.device};
  OutputFolder folder(arguments.folder, output_of(arguments, arguments.folder).inputs);
  draw_again(sliced(read_painting(arguments.files.front()), arguments.slicing), folder, options, session.progress);
  return {{{"folder", arguments.folder, fmt::format("written to       {}", arguments.folder)}}};
}

Report run_paint(const Arguments& given, const Session& session) {
  Arguments arguments = given;
  if (!arguments.print_style.empty()) {
    arguments.style.style = arguments.print_style;
    fmt::print(session.output, "{}", style_to_toml(style_from(arguments.style, session.seed)));
    return {};
  }
  settle_device(arguments.painting.device, session);
  if (is_painting_file(arguments)) return draw_painting_again(arguments, session);
  const bool is_folder = is_photograph_folder(arguments);
  if (has_depth(arguments.depth) && (is_folder || arguments.files.size() > 1))
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format(
            "{}: belongs to one picture, but {} given; where there are two views, --disparity gives that of the "
            "left one",
            option_of(arguments.depth),
            is_folder ? "a folder is" : fmt::format("{} files are", arguments.files.size())));
  const bool in_all_styles = arguments.walk.contact_sheet && !is_folder;
  if (in_all_styles)
    refuse_options(arguments.given, {"--style"}, "with --contact-sheet of one photograph: all are painted");
  const PaintPhotographOptions options = options_from(arguments, session);
  PhotographWork work{
      .input = is_folder ? arguments.files.front() : "",
      .output = arguments.folder,
      .folder = arguments.walk,
      .done = "painted",
      .max_size = arguments.photographs.max_size,
      .work = {},
      .is_done = [](const PhotographJob& job) { return fs::exists(fs::path(job.output) / "report.json"); },
      .shown = [&](const PhotographJob& job) { return painted_picture(job, arguments.results.format); }};
  work.work = [&](const PhotographJob& job, const Session& of_one) {
    return paint_one(arguments_of(arguments, job), job, options, of_one);
  };
  if (in_all_styles) {
    work.work = [&](const PhotographJob& job, const Session& of_one) {
      Arguments one = arguments;
      one.style.style = fs::path(job.output).filename().string();
      return paint_one(arguments_of(one, job), job, options_from(one, of_one), of_one);
    };
    return work_on_all(work, {a_job_for_each_style(arguments)}, session);
  }
  if (is_folder) return work_on_all(work, photographs_to_paint(arguments, session), session);
  const std::vector<PhotographJob> jobs = paint_jobs(arguments);
  if (jobs.size() > 1) return work_on_all(work, {jobs}, session);
  return work.work(jobs.front(), session).report;
}

}  // namespace

Command paint_command() {
  return make_command("paint", "Paint a stereo photograph, one picture and its depth, or a model", paint_rows,
                      run_paint,
                      "Writes left.png and right.png as the photographs lie, side_by_side.png and anaglyph.png for "
                      "viewing, painting.wst\n"
                      "(the marks), disparity, occlusion, and report.json; where the pair was rectified, or made of "
                      "one picture and its\n"
                      "depth, also left_photograph.png and right_photograph.png, the pictures that were painted.\n\n"
                      "Examples:\n  wheatstone synth still -o still\n"
                      "  wheatstone paint still/left.png still/right.png --style impressionist --report -o painted\n"
                      "  wheatstone paint one.mpo two.mpo three.mpo -o painted\n"
                      "  wheatstone paint photographs -o painted\n"
                      "  wheatstone paint photograph.mpo --display looking-glass-portrait -o photograph\n"
                      "  wheatstone paint photo.jpg --depth depth.png -o painted\n"
                      "  wheatstone paint model.glb --style oil --azimuth 60 -o painted");
}

}  // namespace wheatstone::cli
