#include "render_arguments.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <regex>
#include <string_view>

#include "wheatstone/app/render_limits.h"
#include "wheatstone/app/write_values.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/error.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

constexpr std::array<std::string_view, 8> of_files{"FILE",     "--output",      "--quilt",  "--interleave",
                                                   "--values", "--save-slices", "--format", "--stream"};

/// "--look-at" as "look_at".
std::string as_named_in_calls(const std::string& message) {
  static const std::regex option("--[a-z]+(-[a-z]+)*");
  std::string changed;
  auto from = message.begin();
  for (std::sregex_iterator found(message.begin(), message.end(), option), end; found != end; ++found) {
    changed.append(from, (*found)[0].first);
    std::string name = found->str().substr(2);
    std::ranges::replace(name, '-', '_');
    changed += name;
    from = (*found)[0].second;
  }
  return changed.append(from, message.end());
}

}  // namespace

std::string option_of_thesis(const RenderArguments& a) {
  if (a.options.rendering.opaque) return "--opaque";
  return a.options.appearance.blend == Blend::over ? "--blend over" : "";
}

bool is_thesis(const RenderArguments& a) {
  return a.options.appearance.look == Look::thesis || !option_of_thesis(a).empty();
}

bool makes_slices(const RenderArguments& a) { return !a.save_slices.empty() || !a.interleave.empty(); }

bool reads_slices(const RenderArguments& arguments) {
  return std::filesystem::path(arguments.file).extension() == ".exr";
}

bool reads_model(const RenderArguments& arguments) { return !arguments.points && is_model(arguments.file); }

bool makes_film(const RenderArguments& arguments) {
  const Given& given = arguments.given;
  return frame_pattern(arguments.file) || given("--frames") || given("--orbit") || given("--camera");
}

void check_quilt(const QuiltLayout& layout, int views) {
  if (layout.columns * layout.rows != views)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--quilt: is '{}x{}', expected as many places as there are views, {}", layout.columns,
                            layout.rows, views));
}

RenderArguments for_display(const RenderArguments& given) {
  RenderArguments arguments = given;
  if (given.display.empty()) return arguments;
  const DisplayPreset& display = find_display(given.display);
  const auto unless_given = [&](const char* option, auto& value, const auto& preset) {
    if (!given.given(option)) value = preset;
  };
  RenderParticlesOptions& options = arguments.options;
  ViewingGeometry& viewing = options.depth.viewing;
  unless_given("--views", options.views, display.views);
  unless_given("--span", options.span, span_of(display, viewing.eye_separation_mm));
  unless_given("--size", arguments.size, PictureSize{display.view_width_px, display.view_height_px});
  unless_given("--distance", viewing.viewing_distance_mm, display.viewing_distance_mm);
  unless_given("--screen-width", viewing.screen_width_mm, display.screen_width_mm);
  const float depth_mm = usual_depth_mm(display.screen_width_mm);
  unless_given("--near", options.depth.near_mm, depth_mm);
  unless_given("--far", options.depth.far_mm, depth_mm);
  arguments.aspect = display.aspect;
  if (display.quilt_columns > 0 && given.interleave.empty())
    unless_given("--quilt", arguments.quilt, QuiltLayout{display.quilt_columns, display.quilt_rows});
  return arguments;
}

RenderParticlesOptions render_options_from(const RenderArguments& arguments) {
  RenderParticlesOptions options = arguments.options;
  options.width = arguments.size.width;
  options.height = arguments.size.height;
  if (arguments.focus) {
    const auto width = static_cast<float>(options.width), height = static_cast<float>(options.height);
    const auto [x, y] = *arguments.focus;
    options.rendering.focus = Focus{.x_px = static_cast<float>(x) * width,
                                    .y_px = static_cast<float>(y) * height,
                                    .radius_px = arguments.focus_radius * width,
                                    .gain = arguments.focus_gain};
  }
  check_render_options(options);
  if (is_thesis(arguments)) options.appearance.look = Look::thesis;
  options.values = !arguments.values.empty();
  if (options.values) check_values_ending("--values", arguments.values);
  if (reads_model(arguments)) {
    if (!arguments.given("--zoom")) options.framing.zoom = Framing().zoom;
    return options;
  }
  options.slices = makes_slices(arguments);
  options.without_views = !arguments.interleave.empty();
  return options;
}

Rows call_rows(RenderArguments& arguments) {
  Rows rows = render_rows(arguments);
  std::erase_if(rows, [](const Row& row) {
    return row.heading == "Film" || row.needs == "--stream" ||
           std::ranges::find(of_files, name_of(row)) != of_files.end();
  });
  for (Row& row : rows) std::erase_if(row.excludes, [](const std::string& other) { return other == "--quilt"; });
  return rows;
}

RenderArguments arguments_of_call(const std::string& file, std::span<const NamedWords> options) try {
  RenderArguments arguments;
  arguments.file = file;
  const Rows rows = call_rows(arguments);
  arguments.given = set_rows(rows, options);
  refuse_without_effect(rows, arguments.given);
  return for_display(arguments);
} catch (const Error& error) {
  throw Error(error.kind(), as_named_in_calls(error.what()));
}

}  // namespace wheatstone::cli
