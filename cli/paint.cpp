#include <fmt/format.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
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
#include "paint_display.h"
#include "photograph_run.h"
#include "slicing_options.h"
#include "views_argument.h"
#include "wheatstone/app/detail_map.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/process_memory.h"
#include "wheatstone/app/render_limits.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"
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
      arguments.photographs.rectify != RectifyPolicy::never || is_single_picture(arguments) || is_of_model(job);
  std::optional<OutputFolder> folder;
  if (!arguments.display.name.empty()) {
    check_views_output(output);
  } else {
    folder.emplace(output.name, output.inputs);
    for (const std::string& name : result_names(results)) folder->file(name);
  }
  const PaintSubject subject = read_subject(arguments, job, options, session);
  const ReadPhotograph& photograph = subject.photograph;
  const StereoPair& pictures = photograph.pair.pictures;
  if (pictures.right.empty()) refuse_for_flat(arguments, photograph.name);
  results.photographs = subject.strength || photograph.pair.rectification || is_of_model(job);
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
  const bool is_photograph = !subject.strength && !is_of_model(job);
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
  if (!is_of_model(job)) of_one.results.notes = read_photograph_notes(job.left, given.keep_location);
  of_one.files = given.files;
  of_one.files.insert(of_one.files.end(), {job.left, job.right, job.depth});
  return of_one;
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

constexpr double farthest_px = 65535;

Value zero_parallax(std::optional<float>& disparity_px) {
  const auto parse = [](const std::string& option, const std::string& words) -> std::optional<float> {
    if (words == "nearest") return std::nullopt;
    return static_cast<float>(parse_number(option, words, {-farthest_px, farthest_px}));
  };
  return parsed(disparity_px, parse, {}, "nearest");
}

Value zero_parallax_at(std::optional<std::pair<int, int>>& at) {
  return parsed(at, [](const std::string& option, const std::string& words) {
    const std::vector<int> pixel = parse_integers(option, words, {',', 2, {0, farthest_px}, "X,Y"});
    return std::pair(pixel[0], pixel[1]);
  });
}

/// "with --depth" where one picture has its depth from elsewhere, empty where there are two views.
std::string single_picture(const PaintArguments& a) {
  if (is_model_file(a)) return "on a model of triangles";
  if (has_depth(a.depth)) return fmt::format("with {}", option_of(a.depth));
  return finds_depth_in_file(a) ? "on a picture that has its own depth" : "";
}

// Where an option has no effect, and why.
Reason printing(const PaintArguments& a) {
  return when([&a] { return !a.print_style.empty(); }, "with --print-style; nothing is painted");
}
Reason again(const PaintArguments& a) {
  return when([&a] { return is_painting_file(a); }, "on a painting (.wst); it works on photographs");
}
Reason on_photographs(const PaintArguments& a) {
  return when([&a] { return !is_painting_file(a); }, "on photographs; it works on a painting (.wst)");
}
Reason on_display(const PaintArguments& a) {
  return when([&a] { return !a.display.name.empty(); }, "with --display; it works with two eyes");
}
Reason several(const PaintArguments& a) {
  return when([&a] { return are_several(a); }, "on several photographs; it belongs to one");
}
Reason on_model(const PaintArguments& a) {
  return when([&a] { return is_model_file(a); }, "on a model of triangles; it works on photographs");
}
Reason one_view(const PaintArguments& a) {
  return [&a] {
    const std::string situation = single_picture(a);
    return situation.empty() ? "" : situation + "; it works where there are two views";
  };
}

Rows file_rows(PaintArguments& a) {
  const Reason no_disparity =
      when([&a] { return a.disparity.empty(); }, "without --disparity, which is that of the left view");
  return {
      row("PHOTOGRAPHS", texts(a.files),
          "LEFT and RIGHT photograph; or files that hold both views each: MPO, JPS, side by side, one above the other; "
          "or one picture with --depth; or one model of triangles (glTF, OBJ, PLY, STL); or one folder of such "
          "photographs; or one painting.wst, which is drawn again"),
      row("-o,--output", output_name(a.folder), "Folder for the results", {printing(a)}),
      row("--format", picture_format(a.results.format),
          "File format of the painted pictures; masks and disparities are PNG", {printing(a)}),
      row("--print-style", text(a.print_style), "Print a style as a style file (.toml) and exit"),
      row("--disparity", text(a.disparity),
          "Disparity of the left view, which replaces matching: PNG, PFM or EXR as FILE[:SCALE], value / SCALE = "
          "pixels",
          {printing(a), again(a), one_view(a), several(a)}),
      row("--right-disparity", text(a.right_disparity), "Disparity of the right view, in the same form",
          {printing(a), again(a), one_view(a), several(a), no_disparity}),
      row("--detail-map", text(a.detail_map),
          "Picture, stretched over the left photograph, that says how finely each place is painted: white is fine, "
          "mid-grey is as --fineness says; by default, faces are painted more finely than the rest",
          {printing(a), again(a), several(a)})};
}

Rows viewing_rows(PaintArguments& a) {
  const Reason nearest = when([&a] { return !a.display.name.empty() && !a.painting.zero_parallax.disparity_px; },
                              "as 'nearest' with --display; it works with a disparity in pixels");
  return {
      row("--zero-parallax", zero_parallax(a.painting.zero_parallax.disparity_px),
          "Disparity in pixels that lies on the screen plane, or 'nearest'", {printing(a), nearest}),
      row("--zero-parallax-at", zero_parallax_at(a.painting.zero_parallax.at),
          "Pixel X,Y of the left photograph that lies on the screen plane", {printing(a), again(a), several(a)}, {},
          {"--zero-parallax"}),
      row("--depth-budget", depth_budget(a.painting.depth_budget),
          "Largest depth of side_by_side and anaglyph, from the farthest point to the nearest, in % of the width; they "
          "are drawn for eyes that are nearer together. 'full' keeps the depth of the photographs",
          {printing(a), on_display(a)}),
      row("--depth-mapping", depth_regions(a.depth_mapping),
          "Depth at several points, SHARE:MM,SHARE:MM,...: SHARE is from 0, the nearest disparity, to 1, the farthest, "
          "and MM is the depth behind the screen",
          {printing(a)}, {}, {"--zero-parallax", "--zero-parallax-at", "--depth-budget"}),
      row("--distance", without_default(number(a.distance_mm, {1, 1e6})),
          "Viewing distance of a depth mapping, in mm; the display's by default, 700 without one", {printing(a)},
          "--depth-mapping"),
      row("--screen-width", without_default(number(a.screen_width_mm, {1, 1e6})),
          "Width of the screen of a depth mapping, in mm; the display's by default, 376 without one", {printing(a)},
          "--depth-mapping"),
      row("--scale", number(a.scale, {0.01, 32}), "Scale factor of a painting.wst that is drawn again",
          {printing(a), on_photographs(a), on_display(a)}),
      row("--display", text(a.display.name),
          "Paint the views of a display, as one quilt where the display takes one:" + display_names(), {printing(a)}),
      row("--views", without_default(number(a.display.views, view_count_range)),
          "Number of views; the display's own by default", {printing(a)}, "--display"),
      framing_row(a.display.framing, "on the display",
                  {printing(a), when([&a] { return a.display.name.empty(); }, "without --display")})};
}

Rows drawing_rows(PaintArguments& a) {
  const Reason disparity =
      when([&a] { return !a.disparity.empty(); }, "with --disparity; the disparity belongs to the whole picture");
  const Reason given_depth = [&a] {
    return has_depth(a.depth) ? single_picture(a) + "; it works where one file holds two views" : "";
  };
  return {
      device_row(a.painting.device, "Device that draws the planned pictures", {printing(a)}),
      row("--report", flag(a.measure), "Measure the consistency of the two painted views",
          {printing(a), again(a), on_display(a)}),
      row("--svg", flag(a.results.svg), "Also write left.svg and right.svg, the marks as vector graphics",
          {printing(a), on_display(a)}),
      row("--keep-location", flag(a.keep_location),
          "Also write the place where the photograph was taken into the results; its title and the other notes of its "
          "camera are always written",
          {printing(a), again(a)}),
      row("--html", flag(a.results.html), "Also write index.html, which shows the pictures",
          {printing(a), again(a), on_display(a)}),
      layout_row(a.photographs.layout, {printing(a), again(a), given_depth, on_model(a)}, depth_layout_words),
      swap_row(a.photographs.swap, {printing(a), again(a), one_view(a)}),
      max_size_row(a.photographs.max_size, {printing(a), again(a), disparity, on_model(a)}),
      rectify_row(a.photographs.rectify, {printing(a), again(a), one_view(a)})};
}

Rows walk_rows(PaintArguments& a) {
  const auto on_folder = [&a] { return is_photograph_folder(a); };
  Rows rows = folder_rows(a.walk, on_folder, "painted", "; {style}, the name of the style", {printing(a)});
  for (Row& option : rows)
    if (option.names == "--skip-existing") option.unless.push_back(on_display(a));
  rows.push_back(contact_sheet_row(a.walk, [&a] { return is_photograph_folder(a) || !are_several(a); },
                                   {printing(a), again(a), on_display(a)}));
  return rows;
}

Rows paint_rows(PaintArguments& a) {
  const Reason known = [&a] {
    const std::string situation = a.disparity.empty() ? single_picture(a) : "with --disparity";
    return situation.empty() ? "" : situation + "; nothing is matched where the disparity is given";
  };
  const Reason no_depth =
      when([&a] { return single_picture(a).empty() && !is_photograph_folder(a); }, "without --depth");
  const Reason no_map = when([&a] { return !has_depth(a.depth) && !is_photograph_folder(a); }, "without --depth");
  Rows style = under({}, style_rows(a.style), {again(a)});
  style.front().unless.push_back(printing(a));
  return join({file_rows(a), viewing_rows(a), slicing_rows(a.slicing, {printing(a), on_photographs(a)}), walk_rows(a),
               display_view_rows(a.display, {printing(a)}), drawing_rows(a),
               under({}, depth_rows(a.depth, no_depth, no_map), {printing(a), again(a), on_model(a)}), style,
               under({}, match_rows(a.matching), {printing(a), again(a), known}),
               under("Models", model_rows(a.model),
                     {printing(a), when([&a] { return !is_model_file(a); },
                                        "on files other than models; it works on models of triangles")})});
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
