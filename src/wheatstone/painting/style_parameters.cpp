#include "wheatstone/painting/style_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/painting/read_brush.h"

namespace wheatstone {
namespace {

[[noreturn]] void refuse(std::string_view name, std::string_view text, std::string_view expected) {
  throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", name, text, expected));
}

template <class Number>
Number parse_number(std::string_view name, std::string_view text) {
  Number number{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) refuse(name, text, "a number");
  if constexpr (std::is_floating_point_v<Number>)
    if (!std::isfinite(number)) refuse(name, text, "a finite number");
  return number;
}

bool parse_switch(std::string_view name, std::string_view text) {
  if (text == "true" || text == "on") return true;
  if (text == "false" || text == "off") return false;
  refuse(name, text, "on or off, true or false");
}

std::vector<float> parse_list(std::string_view name, std::string_view text) {
  std::vector<float> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    numbers.push_back(parse_number<float>(name, text.substr(begin, end - begin)));
    begin = end + 1;
  }
  return numbers;
}

Rgb8 parse_colour(std::string_view name, std::string_view text) {
  const std::optional<Rgb8> colour = colour_of_code(text);
  if (!colour) refuse(name, text, "a colour as #rrggbb");
  return *colour;
}

/// The beginning of a row.
struct Named {
  std::string_view name, title;
  StyleSection section;
};

constexpr std::span<const Marks> every_kind;
constexpr std::array strokes_only{Marks::strokes, Marks::fitted_strokes};
constexpr std::array traced_only{Marks::strokes};
constexpr std::array fitted_only{Marks::fitted_strokes};
constexpr std::array regions_only{Marks::regions};
constexpr std::array tiles_only{Marks::tiles};

std::string toml_text(std::string_view text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    if (letter == '"' || letter == '\\') quoted += '\\';
    quoted += letter;
  }
  return quoted + '"';
}

/// A parameter for the number that `member(style)` refers to.
template <class Member>
StyleParameter number_at(const Named& named, std::string_view help, Member member, std::span<const Marks> read_by) {
  return {named.name,
          named.title,
          named.section,
          help,
          false,
          [=](const Style& style) { return fmt::format("{}", member(style)); },
          [=, name = named.name](Style& style, std::string_view text) {
            auto& number = member(style);
            number = parse_number<std::remove_cvref_t<decltype(number)>>(name, text);
          },
          read_by};
}

template <class Number>
StyleParameter number(const Named& named, std::string_view help, Number Style::*member,
                      std::span<const Marks> read_by = strokes_only) {
  return number_at(
      named, help, [=](auto& style) -> auto& { return style.*member; }, read_by);
}

StyleParameter jitter(const Named& named, std::string_view help, float ColourJitter::*member) {
  return number_at(
      named, help, [=](auto& style) -> auto& { return style.jitter.*member; }, strokes_only);
}

StyleParameter brush(const Named& named, std::string_view help, float Brush::*member) {
  return number_at(
      named, help, [=](auto& style) -> auto& { return style.brush.*member; }, strokes_only);
}

StyleParameter toggle(const Named& named, std::string_view help, bool Style::*member,
                      std::span<const Marks> read_by = strokes_only) {
  return {named.name,
          named.title,
          named.section,
          help,
          true,
          [=](const Style& style) { return style.*member ? "true" : "false"; },
          [=, name = named.name](Style& style, std::string_view text) { style.*member = parse_switch(name, text); },
          read_by};
}

template <class Value>
StyleParameter choice(const Named& named, std::string_view help, Value Style::*member,
                      std::optional<Value> (*by_name)(std::string_view), std::string_view names,
                      std::span<const Marks> read_by = strokes_only) {
  return {named.name,
          named.title,
          named.section,
          help,
          false,
          [=](const Style& style) { return fmt::format("\"{}\"", name_of(style.*member)); },
          [=, name = named.name](Style& style, std::string_view text) {
            const std::optional<Value> value = by_name(text);
            if (!value) refuse(name, text, names);
            style.*member = *value;
          },
          read_by};
}

// One table in the order of its rows. NOLINTNEXTLINE(readability-function-size)
std::vector<StyleParameter> make_parameters() {
  using enum StyleSection;
  return {
      {"radii", "Brush sizes", strokes,
       "Brush radii from coarse to fine, in pixels of a picture 640 pixels wide: 8,4,2", false,
       [](const Style& style) { return fmt::format("[{}]", fmt::join(style.radii_px, ", ")); },
       [](Style& style, std::string_view text) { style.radii_px = parse_list("radii", text); }, strokes_only},
      toggle({"absolute-radii", "Sizes in pixels of this picture", strokes},
             "Give radii and the depth threshold in pixels of this picture instead", &Style::absolute_radii,
             every_kind),
      number({"threshold", "Tolerance", strokes}, "T: RGB distance (0..441) above which a grid cell gets a stroke",
             &Style::threshold, traced_only),
      number({"grid", "Stroke spacing", strokes},
             "f_g: size of a grid cell, which gets at most one stroke, as a multiple of the radius", &Style::grid,
             traced_only),
      number({"blur", "Blur before painting", strokes},
             "f_s: blur of the photograph for a brush, as a multiple of its radius", &Style::blur),
      number({"curvature", "Stroke bend", strokes},
             "f_c: curvature filter; 1 follows the new direction at once, lower values keep the last one",
             &Style::curvature, traced_only),
      number({"opacity", "Opacity of the paint", colour}, "Opacity of the paint, 0..1", &Style::opacity),
      number({"min-length", "Shortest stroke", strokes}, "Smallest number of control points before a stroke may end",
             &Style::min_length, traced_only),
      number({"max-length", "Longest stroke", strokes}, "Largest number of control points; 0 paints dots",
             &Style::max_length, traced_only),
      jitter({"jitter-hue", "Colour variation: hue", colour}, "Random change of hue, 0..1, at the same lightness",
             &ColourJitter::hue),
      jitter({"jitter-saturation", "Colour variation: saturation", colour},
             "Random change of saturation, 0..1, at the same lightness", &ColourJitter::saturation),
      jitter({"jitter-value", "Colour variation: brightness", colour}, "Random change of brightness, 0..1",
             &ColourJitter::value),
      jitter({"jitter-red", "Colour variation: red", colour}, "Random change of red, 0..1", &ColourJitter::red),
      jitter({"jitter-green", "Colour variation: green", colour}, "Random change of green, 0..1", &ColourJitter::green),
      jitter({"jitter-blue", "Colour variation: blue", colour}, "Random change of blue, 0..1", &ColourJitter::blue),
      number({"fineness", "Fineness", strokes}, "How small a difference is worth a fitted stroke, 0..1",
             &Style::fineness, fitted_only),
      number({"strokes", "Most strokes", strokes},
             "Largest number of fitted strokes, spent where they gain most; 0: as many as fineness asks for",
             &Style::strokes, fitted_only),
      brush({"bristle", "Bristle width", strokes},
            "Width that a bristle leaves, in pixels of a picture 640 pixels wide; 0: none", &Brush::bristle_px),
      brush({"streaks", "Bristle streaks", strokes},
            "Levels by which the paint of a bristle may be lighter or darker, 0..255", &Brush::streaks),
      brush({"ridge", "Ridge of paint at the rim", strokes},
            "Levels by which the paint at a stroke's rim is lit, 0..255", &Brush::ridge),
      brush({"dry", "Dry ends", strokes},
            "Share of a stroke's length before whose end a bristle may run out of paint, 0..1", &Brush::dry),
      {"brush", "Brush", strokes,
       "Brush: none, round, flat, filbert, fan, knife, charcoal, or a picture whose white covers", false,
       [](const Style& style) { return toml_text(style.brush.picture.empty() ? "none" : style.brush.picture.name); },
       [](Style& style, std::string_view text) { style.brush.picture = read_brush(std::string(text)); }, strokes_only},
      toggle({"dual", "Strokes of two colours", colour}, "Strokes of two colours, side by side", &Style::dual,
             traced_only),
      toggle({"texture", "Relief of the paint", strokes}, "Relief of the paint, lit from one side", &Style::texture),
      choice({"marks", "Kind of marks", strokes},
             "Kind of marks: strokes, fitted-strokes, regions of few colours, tiles of a mosaic, or curves",
             &Style::marks, marks_by_name, "strokes, fitted-strokes, regions, tiles or curves", every_kind),
      number({"colours", "Number of colours", colour}, "k: number of colours of a posterised picture", &Style::colours,
             regions_only),
      number({"tile", "Tile width", strokes}, "Width of a mosaic's tiles, in pixels of a picture 640 pixels wide",
             &Style::tile_px, tiles_only),
      toggle({"depth-test", "End strokes at depth edges", depth}, "End strokes at depth edges", &Style::depth_test),
      number({"depth-threshold", "Step that is a depth edge", depth},
             "Disparity step that counts as a depth edge, in pixels of a picture 640 pixels wide",
             &Style::depth_threshold_px, every_kind),
      toggle({"follow-depth-edges", "Follow depth edges", depth},
             "Let the finest strokes beside depth edges run along them; otherwise they are dots",
             &Style::follow_depth_edges, traced_only),
      number({"occlusion-dilation", "Margin of hidden areas", depth},
             "Dilation of the occlusion masks, as a multiple of the largest radius", &Style::occlusion_dilation),
      choice({"propagation", "Painting of the second eye", depth},
             "How the second eye is painted: strokes, raster or independent", &Style::propagation, propagation_by_name,
             "strokes, raster or independent", every_kind),
      choice({"orientation", "Stroke direction", strokes},
             "Direction of strokes in areas without texture: smooth, or gradient (strokes end there)",
             &Style::orientation, orientation_by_name, "smooth or gradient", traced_only),
      choice({"reference-filter", "Kind of blur", strokes}, "Filter that blurs the photograph: median or gaussian",
             &Style::reference_filter, reference_filter_by_name, "median or gaussian"),
      choice({"background", "Background", colour}, "Background behind the paint: photograph or colour",
             &Style::background, background_by_name, "photograph or colour"),
      {"canvas-colour", "Canvas colour", colour, "Colour of the bare canvas, #rrggbb", false,
       [](const Style& style) {
         const Rgb8 c = style.canvas_colour;
         return fmt::format("\"#{:02x}{:02x}{:02x}\"", c.r, c.g, c.b);
       },
       [](Style& style, std::string_view text) { style.canvas_colour = parse_colour("canvas-colour", text); },
       strokes_only},
  };
}

/// A TOML value as the text that a parameter's `set` takes.
std::string text_of(const toml::node& node) {
  if (const auto* list = node.as_array()) {
    std::vector<std::string> texts;
    for (const toml::node& entry : *list) texts.push_back(text_of(entry));
    return fmt::format("{}", fmt::join(texts, ","));
  }
  if (const auto* text = node.as_string()) return text->get();
  if (const auto* real = node.as_floating_point()) return fmt::format("{}", real->get());
  if (const auto* integer = node.as_integer()) return fmt::format("{}", integer->get());
  if (const auto* truth = node.as_boolean()) return truth->get() ? "true" : "false";
  return "a table or date";
}

const StyleParameter* find_parameter(std::string_view name) {
  for (const StyleParameter& parameter : style_parameters())
    if (parameter.name == name) return &parameter;
  return nullptr;
}

void apply_key(std::string_view key, const toml::node& node, Style& style) {
  if (key == "style") return;
  const StyleParameter* parameter = find_parameter(key);
  if (!parameter) {
    std::vector<std::string_view> names{"style"};
    for (const StyleParameter& known : style_parameters()) names.push_back(known.name);
    throw Error(ErrorKind::bad_input, fmt::format("unknown key '{}', expected one of {}", key, fmt::join(names, ", ")));
  }
  parameter->set(style, text_of(node));
}

}  // namespace

std::span<const StyleParameter> style_parameters() {
  static const std::vector<StyleParameter> parameters = make_parameters();
  return parameters;
}

bool is_read_by(const StyleParameter& parameter, Marks marks) {
  return parameter.read_by.empty() || std::ranges::find(parameter.read_by, marks) != parameter.read_by.end();
}

std::string style_to_toml(const Style& style) {
  std::string document = fmt::format("style = \"{}\"\n", style.name);
  for (const StyleParameter& parameter : style_parameters())
    document += fmt::format("\n# {}\n{} = {}\n", parameter.help, parameter.name, parameter.toml_value(style));
  return document;
}

void apply_toml(std::string_view document, std::string_view name, Style& style) {
  try {
    const toml::table table = toml::parse(document);
    if (const toml::node* preset = table.get("style")) style = style_by_name(text_of(*preset));
    for (const auto& [key, node] : table) apply_key(key.str(), node, style);
    check_style(style);
  } catch (const toml::parse_error& error) {
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: line {}: {}", name, error.source().begin.line, error.description()));
  } catch (const Error& error) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", name, error.what()));
  }
}

Style read_style(const std::string& name_or_path) {
  const std::filesystem::path path = name_or_path;
  if (path.extension() != ".toml" && !path.has_parent_path()) return style_by_name(name_or_path);
  constexpr std::size_t most_bytes = 1 << 20;
  Style style;
  apply_toml(read_whole_file(path, most_bytes), name_or_path, style);
  return style;
}

}  // namespace wheatstone
