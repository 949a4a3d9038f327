#include "paint_display.h"

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

#include "display_argument.h"
#include "views_argument.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/marks/painting_file.h"

namespace wheatstone::cli {
namespace {

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

/// Writes the views of a display.
PhotographResult write_and_tell(const PaintArguments& arguments, const DisplayPreset& display,
                                const std::string& output, const DisplayViews& drawn, const Session& session) {
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

Report draw_for_display_again(const PaintArguments& arguments, const Session& session) {
  check_views_output(output_of(arguments, arguments.folder));
  const DisplayPreset& display = find_display(arguments.display.name);
  DisplayViewsOptions options = views_options(arguments, display);
  options.zero_parallax_px = arguments.painting.zero_parallax.disparity_px;
  const DisplayViews views =
      draw_display_views(sliced(read_painting_for_views(arguments.files.front()), arguments.slicing), options,
                         session.progress, composition_for(display, options.views));
  return write_and_tell(arguments, display, arguments.folder, views, session).report;
}

}  // namespace

ViewsOutput output_of(const PaintArguments& arguments, const std::string& name) {
  ViewsOutput output{name, {arguments.style.style, arguments.matching.model}, arguments.results.format};
  output.notes = arguments.results.notes;
  output.inputs.insert(output.inputs.end(), arguments.files.begin(), arguments.files.end());
  output.inputs.emplace_back(arguments.depth.file);
  output.inputs.emplace_back(arguments.detail_map);
  output.inputs.emplace_back(arguments.depth.model);
  output.inputs.push_back(arguments.model.seen.model.choice.texture);
  for (const std::string& disparity : {arguments.disparity, arguments.right_disparity}) {
    output.inputs.emplace_back(disparity);
    output.inputs.emplace_back(disparity.substr(0, disparity.rfind(':')));  // FILE:SCALE
  }
  return output;
}

DisplayViewsOptions views_options(const PaintArguments& arguments, const DisplayPreset& display) {
  DisplayViewsOptions options = display_views_options(display, arguments.display);
  options.depth = depth_placing_from(arguments);
  options.device = arguments.painting.device;
  return options;
}

PhotographResult with_place(Report report, std::string written) {
  report.facts.push_back(only_text(fmt::format("written to       {}", written)));
  return {std::move(report), std::move(written)};
}

PhotographResult paint_for_display(const PaintArguments& arguments, const PhotographJob& job,
                                   const PaintSubject& subject, const PaintPhotographOptions& painting,
                                   const Session& session) {
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

Report draw_painting_again(const PaintArguments& arguments, const Session& session) {
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

}  // namespace wheatstone::cli
