#include <fmt/format.h>
#include <fmt/ostream.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "command.h"
#include "disparity_argument.h"
#include "match_options.h"
#include "numbers_argument.h"
#include "output_option.h"
#include "size_argument.h"
#include "stereo_arguments.h"
#include "style_options.h"
#include "wheatstone/app/paint_views.h"
#include "wheatstone/app/redraw.h"
#include "wheatstone/app/write_results.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/marks/style_parameters.h"
#include "wheatstone/pictures/write_image.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

struct Arguments {
  StereoArguments photographs;
  std::string folder = "painted";
  std::string print_style;
  std::string disparity, right_disparity;
  std::string zero_parallax = "nearest";
  std::string zero_parallax_at;
  double scale = 1;
  std::string display, size;
  int views = 0;
  float span = 0;
  bool measure = false;
  bool html = false;
  bool svg = false;
  MatchArguments matching;
  StyleArguments style;
};

ZeroParallax parse_zero_parallax(const Arguments& arguments) {
  ZeroParallax wanted;
  if (!arguments.zero_parallax_at.empty()) {
    const std::string& text = arguments.zero_parallax_at;
    const char* end = text.data() + text.size();
    int x = 0, y = 0;
    const auto first = std::from_chars(text.data(), end, x);
    const bool comma = first.ec == std::errc{} && first.ptr != end && *first.ptr == ',';
    const auto second = comma ? std::from_chars(first.ptr + 1, end, y) : first;
    if (!comma || second.ec != std::errc{} || second.ptr != end)
      throw Error(ErrorKind::wrong_usage, fmt::format("--zero-parallax-at: is '{}', expected X,Y", text));
    wanted.at = {x, y};
  } else if (arguments.zero_parallax != "nearest") {
    const std::string& text = arguments.zero_parallax;
    float disparity = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), disparity);
    if (error != std::errc{} || stop != text.data() + text.size())
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--zero-parallax: is '{}', expected 'nearest' or a disparity in pixels", text));
    wanted.disparity_px = disparity;
  }
  return wanted;
}

void print_summary(const PaintedPhotograph& result, const PaintingMeasures* measures, const Arguments& arguments,
                   const Session& session) {
  const PaintedPair& painted = result.painted;
  std::size_t strokes = 0;
  for (const Layer& layer : painted.painting.layers) strokes += layer.strokes.size();
  const double seconds = painted.times.planning_s + painted.times.rasterising_s;
  if (!painted.curves.lines.empty()) {
    fmt::print(session.output, "painted          {} lines beside edges, {:.2f} s\n", painted.curves.lines.size(),
               seconds);
  } else if (painted.regions.marks.empty()) {
    fmt::print(session.output, "painted          {} strokes in {} layers, {:.2f} s\n", strokes,
               painted.painting.layers.size(), seconds);
  } else {
    fmt::print(session.output, "painted          {} regions, {:.2f} s\n", painted.regions.marks.size(), seconds);
  }
  fmt::print(session.output, "left bare        {:.2f} % of the left eye, {:.2f} % of the right\n",
             100 * painted.left_bare_share, 100 * painted.right_bare_share);
  fmt::print(session.output, "zero parallax    disparity {:.1f} px\n", result.zero_parallax_px);
  if (measures != nullptr) {
    fmt::print(session.output, "left - right     {:.2f} of 255 (photographs {:.2f})\n",
               measures->painting.difference.mean_absolute, measures->photographs.difference.mean_absolute);
    fmt::print(session.output, "depth lost       {:.1f} % off by over 2 px (photographs {:.1f} %)\n",
               100 * measures->painting.survival.bad_2, 100 * measures->photographs.survival.bad_2);
  }
  fmt::print(session.output, "written to       {}\n", arguments.folder);
}

/// Where the results go, and all that is read for them.
ViewsOutput output_of(const Arguments& arguments) {
  ViewsOutput output{
      arguments.folder,
      {arguments.photographs.left, arguments.photographs.right, arguments.style.style, arguments.matching.model}};
  for (const std::string& disparity : {arguments.disparity, arguments.right_disparity}) {
    output.inputs.emplace_back(disparity);
    output.inputs.emplace_back(disparity.substr(0, disparity.rfind(':')));  // FILE:SCALE
  }
  return output;
}

/// What a display wants, where the user does not say otherwise.
PaintViewsOptions views_options(const Arguments& arguments, const PaintPhotographOptions& painting) {
  const DisplayPreset& display = find_display(arguments.display);
  PaintViewsOptions options{.painting = painting,
                            .views = arguments.views > 0 ? arguments.views : display.views,
                            .width = display.view_width_px,
                            .height = display.view_height_px,
                            .span = arguments.span,
                            .widest_span = std::max(span_of(display), 1.f)};
  if (!arguments.size.empty()) {
    take_view_size(arguments.size, options.width, options.height);
  }
  return options;
}

/// Writes a quilt or a lenticular picture where the display takes one, and else a picture a view.
std::string write_views(const Arguments& arguments, const PaintedViews& result) {
  const DisplayPreset& display = find_display(arguments.display);
  const QuiltLayout layout{display.quilt_columns, display.quilt_rows};
  if (layout.columns * layout.rows == static_cast<int>(result.views.size()))
    return write_quilt(result.views, layout, display.aspect, output_of(arguments));
  if (display.lenses.screen_width_px > 0)
    return write_lenticular(result.views, lenticular_screen_of(display), output_of(arguments));
  write_view_folder(result.views, output_of(arguments));
  return arguments.folder;
}

void paint_for_display(const Arguments& arguments, const PreparedPair& photographs,
                       const PaintPhotographOptions& painting, const Session& session) {
  const PaintViewsOptions options = views_options(arguments, painting);
  const PaintedViews result = paint_views(photographs.pictures, options, session.progress);
  const std::string written = write_views(arguments, result);
  if (session.json) {
    const nlohmann::ordered_json facts{{"output", written},
                                       {"views", result.views.size()},
                                       {"width", options.width},
                                       {"height", options.height},
                                       {"span", result.span},
                                       {"zero_parallax_px", result.zero_parallax_px},
                                       {"worst_bare_share", result.worst_bare_share},
                                       {"pair", nlohmann::ordered_json::parse(preparation_json(photographs))}};
    fmt::print(session.output, "{}\n", facts.dump(2));
    return;
  }
  fmt::print(session.output, "painted          {} views of {}x{} pixels, {:.2f} eye separations from first to last\n",
             result.views.size(), options.width, options.height, result.span);
  fmt::print(session.output, "zero parallax    disparity {:.1f} px\n", result.zero_parallax_px);
  fmt::print(session.output, "left bare        at most {:.2f} % of a view, filled from its neighbours\n",
             100 * result.worst_bare_share);
  fmt::print(session.output, "written to       {}\n", written);
}

void paint_photographs(const Arguments& arguments, const Session& session) {
  PaintPhotographOptions options;
  options.style = style_from(arguments.style, session.seed);
  options.matching = match_options_from(arguments.matching);
  options.zero_parallax = parse_zero_parallax(arguments);
  if (arguments.disparity.empty() && !arguments.right_disparity.empty())
    throw Error(ErrorKind::wrong_usage, "--right-disparity needs --disparity, the left eye's");
  if (!arguments.disparity.empty() && !arguments.matching.range.empty())
    throw Error(ErrorKind::wrong_usage, "--range says how to match, but --disparity gives the disparity: choose one");
  // What makes no sense, or cannot be written, is said before the work.
  const ResultOptions results{.html = arguments.html, .svg = arguments.svg};
  std::optional<OutputFolder> folder;
  if (!arguments.display.empty()) {
    views_options(arguments, options);
    check_views_output(output_of(arguments));
  } else {
    folder.emplace(arguments.folder, output_of(arguments).inputs);
    for (const std::string& name : result_names(results)) folder->file(name);
  }
  const PreparedPair prepared = read_photographs(arguments.photographs, !arguments.disparity.empty(), session);
  const StereoPair& photographs = prepared.pictures;
  std::optional<Image<float>> truth;
  if (!arguments.disparity.empty()) {
    truth = read_disparity_argument(arguments.disparity);
    options.left_disparity = truth;
  }
  if (!arguments.right_disparity.empty()) options.right_disparity = read_disparity_argument(arguments.right_disparity);

  if (!arguments.display.empty()) return paint_for_display(arguments, prepared, options, session);

  const PaintedPhotograph result = paint_photograph(photographs, options, session.progress);
  std::optional<PaintingMeasures> measures;
  if (arguments.measure)
    measures = measure_painting(photographs, result, truth ? *truth : result.geometry.left_disparity);
  const PaintingMeasures* measured = measures ? &*measures : nullptr;
  const PaintingReport report{result, options.style, &prepared, measured};
  write_results(*folder, photographs, report, results, session.progress);
  if (session.json) {
    fmt::print(session.output, "{}", report_json(report));
  } else {
    print_summary(result, measured, arguments, session);
  }
}

void run(const Arguments& arguments, const Session& session) {
  if (!arguments.print_style.empty()) {
    fmt::print(session.output, "{}", style_to_toml(read_style(arguments.print_style)));
    return;
  }
  const std::string& left = arguments.photographs.left;
  if (left.empty())
    throw Error(ErrorKind::wrong_usage, "paint needs two photographs, LEFT and RIGHT, or one file with both views");
  if (!arguments.photographs.right.empty() || !left.ends_with(".wst")) return paint_photographs(arguments, session);
  if (!arguments.display.empty())
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: a painting holds what two eyes show; the views of a display are painted from the "
                            "photographs, with 'wheatstone paint LEFT RIGHT --display {}'",
                            left, arguments.display));
  OutputFolder folder(arguments.folder, output_of(arguments).inputs);
  draw_again(read_painting(left), folder, {.scale = arguments.scale, .svg = arguments.svg});
  if (session.json) {
    fmt::print(session.output, "{{\"folder\": \"{}\"}}\n", arguments.folder);
  } else {
    fmt::print(session.output, "written to       {}\n", arguments.folder);
  }
}

}  // namespace

void add_paint_command(CLI::App& program, const Session& session) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App& command = *program.add_subcommand("paint", "A stereo painting from a rectified pair of photographs");
  command.add_option("LEFT", arguments->photographs.left,
                     "Left photograph; or one file with both views: MPO, JPS, side by side, one above the other; or a "
                     "painting.wst, to draw it again");
  command.add_option("RIGHT", arguments->photographs.right, "Right photograph, of the same size");
  add_output_option(command, arguments->folder, "Folder for the results");
  command.add_option("--print-style", arguments->print_style, "Print a style as a file to change, and do nothing else");
  command.add_option(
      "--disparity", arguments->disparity,
      "Left view's disparity instead of matching: PNG, PFM or EXR, FILE[:SCALE], value / SCALE = pixels");
  command.add_option("--right-disparity", arguments->right_disparity, "The right view's own, if there is one");
  auto* plane = command.add_option("--zero-parallax", arguments->zero_parallax,
                                   "What lies on the screen plane: 'nearest', or a disparity in pixels");
  plane->capture_default_str();
  command.add_option("--zero-parallax-at", arguments->zero_parallax_at, "... or this pixel X,Y of the left photograph")
      ->excludes(plane);
  command.add_option("--scale", arguments->scale, "Draw a painting.wst this many times as large")
      ->check(CLI::Range(0.01, 32.0))
      ->capture_default_str();
  std::string names;
  for (const DisplayPreset& display : display_presets()) names += fmt::format(" {}", display.name);
  auto* display = command.add_option(
      "--display", arguments->display,
      "Paint the views of a display, as one quilt or lenticular picture where it takes one:" + names);
  command.add_option("--views", arguments->views, "How many, instead of the display's")
      ->check(CLI::Range(1, 1000))
      ->needs(display);
  command.add_option("--size", arguments->size, "WIDTHxHEIGHT of a view, instead of the display's")->needs(display);
  command.add_option("--span", arguments->span, "Eye separations from the first view to the last; chosen if not given")
      ->check(CLI::Range(0.01, 20.0))
      ->needs(display);
  command.add_flag("--report", arguments->measure, "Measure how well the painting's two eyes fit together");
  command.add_flag("--svg", arguments->svg, "Also write left.svg and right.svg, the marks as vector graphics");
  command.add_flag("--html", arguments->html, "Also write index.html, which shows the pictures");
  add_stereo_options(command, arguments->photographs);
  add_rectify_option(command, arguments->photographs);
  add_style_options(command, arguments->style);
  add_match_options(command, arguments->matching);
  command.footer(
      "Writes left.png and right.png as the photographs lie, side_by_side.png and anaglyph.png for viewing, "
      "painting.wst\n"
      "(the marks), disparity, occlusion, and report.json.\n\n"
      "Examples:\n  wheatstone synth still -o still\n"
      "  wheatstone paint still/left.png still/right.png --style impressionist --report -o painted\n"
      "  wheatstone paint photograph.mpo --display looking-glass-portrait -o photograph");
  command.callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace wheatstone::cli
