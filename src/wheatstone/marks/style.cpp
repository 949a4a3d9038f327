#include "wheatstone/marks/style.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

constexpr std::array<std::string_view, 10> preset_names{
    "oil",         "impressionist", "expressionist", "colorist-wash", "pointillist",
    "psychedelic", "dual",          "posterise",     "mosaic",        "diffusion"};

constexpr std::array kinds_of_marks{std::pair{Marks::strokes, std::string_view("strokes")},
                                    std::pair{Marks::fitted_strokes, std::string_view("fitted-strokes")},
                                    std::pair{Marks::regions, std::string_view("regions")},
                                    std::pair{Marks::tiles, std::string_view("tiles")},
                                    std::pair{Marks::curves, std::string_view("curves")}};

constexpr std::array propagations{std::pair{Propagation::strokes, std::string_view("strokes")},
                                  std::pair{Propagation::raster, std::string_view("raster")},
                                  std::pair{Propagation::independent, std::string_view("independent")}};
constexpr std::array orientations{std::pair{Orientation::smooth, std::string_view("smooth")},
                                  std::pair{Orientation::gradient, std::string_view("gradient")}};
constexpr std::array reference_filters{std::pair{ReferenceFilter::median, std::string_view("median")},
                                       std::pair{ReferenceFilter::gaussian, std::string_view("gaussian")}};
constexpr std::array backgrounds{std::pair{Background::photograph, std::string_view("photograph")},
                                 std::pair{Background::colour, std::string_view("colour")}};

template <class Table, class Value>
std::string_view find_name(const Table& table, Value value) {
  for (const auto& [entry, name] : table)
    if (entry == value) return name;
  return {};
}

template <class Table>
auto find_value(const Table& table, std::string_view name) {
  std::optional<std::remove_cvref_t<decltype(table[0].first)>> found;
  for (const auto& [entry, entry_name] : table)
    if (entry_name == name) found = entry;
  return found;
}

[[noreturn]] void refuse(std::string_view parameter, float value, std::string_view expected) {
  throw Error(ErrorKind::wrong_usage, fmt::format("style: {} is {}, expected {}", parameter, value, expected));
}

void check_range(std::string_view parameter, float value, float low, float high) {
  if (!(value >= low && value <= high)) refuse(parameter, value, fmt::format("{} to {}", low, high));
}

}  // namespace

std::span<const std::string_view> style_names() { return preset_names; }

Style style_by_name(std::string_view name) {
  Style style;
  style.name = name;
  if (name == "oil") {
    style.marks = Marks::fitted_strokes;
    style.radii_px = {20, 1.3f};
    style.blur = 0.25f;
    style.reference_filter = ReferenceFilter::gaussian;
    style.fineness = 0.43f;
    style.brush = {.bristle_px = 1, .streaks = 12, .ridge = 8, .dry = 0.35f};
    return style;
  }
  style.dual = name == "dual";
  if (style.dual) style.brush = {.bristle_px = 1, .streaks = 14, .ridge = 14, .dry = 0.3f};
  if (name == "impressionist" || style.dual) return style;
  if (name == "expressionist") {
    style.threshold = 50;
    style.curvature = 0.25f;
    style.opacity = 0.7f;
    style.min_length = 10;
    style.jitter.value = 0.5f;
    return style;
  }
  if (name == "colorist-wash") {
    style.threshold = 200;
    style.opacity = 0.5f;
    style.jitter.hue = 0.1f;
    style.jitter.saturation = 0.3f;
    style.jitter.value = 0.1f;
    return style;
  }
  if (name == "pointillist") {
    style.radii_px = {4, 2};
    style.grid = 0.5f;
    style.min_length = 0;
    style.max_length = 0;
    style.jitter.hue = 0.2f;
    style.jitter.saturation = 0.6f;
    style.jitter.value = 0.06f;
    return style;
  }
  if (name == "psychedelic") {
    style.threshold = 50;
    style.curvature = 0.5f;
    style.opacity = 0.7f;
    style.min_length = 10;
    style.jitter.hue = 0.5f;
    style.jitter.saturation = 0.5f;
    return style;
  }
  constexpr std::array<std::pair<std::string_view, Marks>, 3> of_other_marks{
      {{"posterise", Marks::regions}, {"diffusion", Marks::curves}, {"mosaic", Marks::tiles}}};
  for (const auto& [other, marks] : of_other_marks) {
    if (name != other) continue;
    style.marks = marks;
    return style;
  }
  throw Error(ErrorKind::wrong_usage,
              fmt::format("style: there is no '{}', expected {}", name, fmt::join(preset_names, ", ")));
}

void check_style(const Style& style) {
  if (style.radii_px.empty() || style.radii_px.size() > 16)
    refuse("the number of radii", static_cast<float>(style.radii_px.size()), "1 to 16");
  for (const float radius : style.radii_px) check_range("radius", radius, 0.5f, 500);
  for (std::size_t i = 1; i < style.radii_px.size(); ++i)
    if (style.radii_px[i] > style.radii_px[i - 1]) refuse("radius", style.radii_px[i], "radii from coarse to fine");
  check_range("threshold", style.threshold, 1, 442);
  check_range("grid", style.grid, 0.1f, 10);
  check_range("blur", style.blur, 0, 10);
  check_range("curvature", style.curvature, 0.01f, 1);
  check_range("opacity", style.opacity, 0.01f, 1);
  check_range("min-length", static_cast<float>(style.min_length), 0, 1000);
  check_range("max-length", static_cast<float>(style.max_length), 0, 1000);
  if (style.min_length > style.max_length)
    refuse("min-length", static_cast<float>(style.min_length), fmt::format("at most max-length, {}", style.max_length));
  const ColourJitter& j = style.jitter;
  for (const float amount : {j.hue, j.saturation, j.value, j.red, j.green, j.blue}) check_range("jitter", amount, 0, 1);
  check_range("fineness", style.fineness, 0, 1);
  check_range("strokes", static_cast<float>(style.strokes), 0, 1e7f);
  check_range("streaks", style.brush.streaks, 0, 255);
  check_range("ridge", style.brush.ridge, 0, 255);
  check_range("dry", style.brush.dry, 0, 1);
  check_range("bristle", style.brush.bristle_px, 0, 500);
  check_range("colours", static_cast<float>(style.colours), 2, 256);
  check_range("tile", style.tile_px, 2, 500);
  if (!is_of_strokes(style) && style.propagation == Propagation::raster)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("style: propagation is raster, expected strokes or independent for {}", name_of(style.marks)));
  if (!is_of_strokes(style) && style.texture)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("style: texture can be used with strokes only, not with {}", name_of(style.marks)));
  check_range("depth-threshold", style.depth_threshold_px, 0.01f, 1000);
  check_range("occlusion-dilation", style.occlusion_dilation, 0, 10);
}

float style_scale(const Style& style, int width) {
  constexpr float nominal_width = 640;
  return style.absolute_radii ? 1 : static_cast<float>(width) / nominal_width;
}

Brush brush_for(const Style& style, int width) {
  Brush brush = style.brush;
  const bool is_even = brush.streaks == 0 && brush.ridge == 0 && brush.dry == 0 && brush.picture.empty();
  if (!is_of_strokes(style) || is_even) return {};
  if (brush.bristle_px > 0) brush.bristle_px = std::max(brush.bristle_px * style_scale(style, width), 1.f);
  return brush;
}

std::string_view name_of(Marks marks) { return find_name(kinds_of_marks, marks); }
std::string_view name_of(Propagation propagation) { return find_name(propagations, propagation); }
std::string_view name_of(Orientation orientation) { return find_name(orientations, orientation); }
std::string_view name_of(ReferenceFilter filter) { return find_name(reference_filters, filter); }
std::string_view name_of(Background background) { return find_name(backgrounds, background); }
std::optional<Marks> marks_by_name(std::string_view name) { return find_value(kinds_of_marks, name); }
std::optional<Propagation> propagation_by_name(std::string_view name) { return find_value(propagations, name); }
std::optional<Orientation> orientation_by_name(std::string_view name) { return find_value(orientations, name); }
std::optional<ReferenceFilter> reference_filter_by_name(std::string_view name) {
  return find_value(reference_filters, name);
}
std::optional<Background> background_by_name(std::string_view name) { return find_value(backgrounds, name); }

}  // namespace wheatstone
