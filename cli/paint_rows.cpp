#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "device_option.h"
#include "display_argument.h"
#include "paint_arguments.h"
#include "photograph_run.h"
#include "slicing_options.h"
#include "views_argument.h"
#include "wheatstone/app/render_limits.h"
#include "write_views_output.h"

namespace wheatstone::cli {
namespace {

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

Rows model_rows(PaintArguments& a) {
  RenderParticlesOptions& seen = a.model;
  constexpr static std::array<Choice<UpAxis>, 3> axes{
      {{"auto", UpAxis::by_format}, {"y", UpAxis::y}, {"z", UpAxis::z}}};
  seen.framing.zoom = Framing().zoom;
  // About 3 % of the width from the nearest point to the farthest.
  seen.depth.near_mm = 55;
  seen.depth.far_mm = 60;
  return under(
      "Models",
      {row("--azimuth", number(seen.framing.azimuth_deg, {-360, 360}),
           "Direction that the camera looks from, in degrees"),
       row("--elevation", number(seen.framing.elevation_deg, elevation_range),
           "Height of the camera above the horizon, in degrees"),
       row("--fov", number(seen.framing.field_of_view_deg, field_of_view_range),
           "Horizontal field of view, in degrees"),
       row("--zoom", number(seen.framing.zoom, zoom_range), "Magnification: 2 shows half as much"),
       row("--picture-size", size(a.model_size, view_side_range), "Size of the painted pictures: WIDTHxHEIGHT"),
       row("--up", choice(seen.model.choice.up, axes),
           "Axis of the model that is up; auto: y in OBJ and glTF, z in PLY and STL"),
       row("--crease", number(seen.model.choice.crease_deg, crease_range_deg),
           "For models without normals: triangles that meet at a larger angle than this, in degrees, have an edge "
           "between them"),
       row("--model-texture", of_type("FILE", text(seen.model.choice.texture)),
           "Texture picture for a model that names none"),
       row("--model-background", parsed(seen.model.background, parse_colour, "COLOUR", "#3a3e44"),
           "Colour around the model")},
      {printing(a),
       when([&a] { return !is_model_file(a); }, "on files other than models; it works on models of triangles")});
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

}  // namespace

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
               under({}, match_rows(a.matching), {printing(a), again(a), known}), model_rows(a)});
}

}  // namespace wheatstone::cli
