#include "wheatstone/drawing/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <string_view>
#include <vector>

#include "wheatstone/drawing/fit_curve_internal.h"
#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"
#include "wheatstone/drawing/visible_strokes_internal.h"
#include "wheatstone/marks/spline.h"

namespace wheatstone {
namespace {

constexpr int units_a_pixel = 10;

/// Writes an SVG document, whose coordinates are whole tenths of a pixel.
class Document {
 public:
  Document(int width, int height, std::string_view attributes) {
    add(R"(<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink" )"
        R"(width="{}" height="{}" viewBox="0 0 {} {}" {}>)"
        "\n",
        width, height, units_a_pixel * width, units_a_pixel * height, attributes);
  }

  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
  }

  // A path's data: moves and curves from the place that was reached, in the shortest numbers.
  void move_to(PlanePoint place) {
    reached_ = rounded(place);
    add("M{} {}", reached_.x, reached_.y);
    command_ = 'M';
  }
  void line_to(PlanePoint place) {
    const Place to = rounded(place);
    if (to == reached_) return;
    begin_command('l');
    add_step(to);
    reached_ = to;
  }
  void curve_to(const BezierCurve& curve) {
    const Place first = rounded(curve.first), second = rounded(curve.second), to = rounded(curve.end);
    if (is_straight(first, second, to)) return line_to(curve.end);
    begin_command('c');
    add_step(first);
    add_step(second);
    add_step(to);
    reached_ = to;
  }
  /// A dot is a line that goes nowhere.
  void end_line() {
    if (command_ == 'M') add("h0");
  }
  void close_ring() {
    add("z");
    command_ = 'z';
  }

  std::string finished() {
    add("</svg>\n");
    return fmt::to_string(text_);
  }

 private:
  struct Place {
    int x, y;
    friend bool operator==(const Place&, const Place&) = default;
  };

  static Place rounded(PlanePoint place) {
    return {static_cast<int>(std::lround(units_a_pixel * place.x)),
            static_cast<int>(std::lround(units_a_pixel * place.y))};
  }

  /// Whether the inner points lie on the way from the reached place to the end, to within rounding.
  bool is_straight(Place first, Place second, Place to) const {
    const double dx = to.x - reached_.x, dy = to.y - reached_.y, length = std::hypot(dx, dy);
    const auto beside = [&](Place p) { return std::abs(dx * (p.y - reached_.y) - dy * (p.x - reached_.x)); };
    const auto along = [&](Place p) { return dx * (p.x - reached_.x) + dy * (p.y - reached_.y); };
    const auto between = [&](Place p) { return along(p) >= 0 && along(p) <= length * length; };
    constexpr double units = 0.6;
    return beside(first) <= units * length && beside(second) <= units * length && between(first) && between(second);
  }

  /// A command that is that of the step before is not repeated.
  void begin_command(char command) {
    if (command != command_) {
      text_.push_back(command);
      needs_space_ = false;
    }
    command_ = command;
  }
  void add_number(int number) {
    if (needs_space_ && number >= 0) text_.push_back(' ');
    add("{}", number);
    needs_space_ = true;
  }
  void add_step(Place to) {
    add_number(to.x - reached_.x);
    add_number(to.y - reached_.y);
  }

  fmt::memory_buffer text_;
  Place reached_{0, 0};
  char command_ = ' ';
  bool needs_space_ = false;
};

float svg_units(float px) { return std::round(100 * px) / 10; }

/// The parts of a stroke's spline that a view sees.
std::vector<std::vector<PlanePoint>> seen_chains(const ClampedSpline& spline, ViewPosition planned_in,
                                                 ViewPosition view, const Hiding& hiding) {
  constexpr int samples_a_span = 4;
  std::vector<std::vector<PlanePoint>> chains;
  bool hidden_before = true;
  const auto add = [&](const SpatialPoint& point) {
    const PlanePoint place = seen_from(point, view);
    const bool hidden = is_hidden(place.x, place.y, point.disparity, planned_in, hiding);
    if (hidden_before && !hidden) chains.emplace_back();
    if (!hidden) chains.back().push_back(place);
    hidden_before = hidden;
  };
  add(spline.control(0));
  for (int span = 0; span < spline.span_count(); ++span)
    for (int i = 1; i <= samples_a_span; ++i) add(point_on(spline, span, static_cast<float>(i) / samples_a_span));
  return chains;
}

void add_stroke(Document& document, const Layer& layer, const Stroke& stroke,
                std::span<const std::vector<PlanePoint>> chains) {
  if (chains.empty()) return;
  document.add("<path stroke=\"#{:02x}{:02x}{:02x}\"", stroke.colour.r, stroke.colour.g, stroke.colour.b);
  if (stroke.radius_px != layer.radius_px)
    document.add(" stroke-width=\"{}\"", svg_units(2 * BrushProfile(stroke.radius_px).middle_px));
  if (stroke.opacity != layer.strokes.front().opacity) document.add(" stroke-opacity=\"{:.3g}\"", stroke.opacity);
  document.add(" d=\"");
  for (const std::vector<PlanePoint>& chain : chains) {
    document.move_to(chain.front());
    for (const BezierCurve& curve : fit_curves(chain, svg_tolerance_px)) document.curve_to(curve);
    document.end_line();
  }
  document.add("\"/>\n");
}

void add_layer(Document& document, const Layer& layer, ViewPosition view, const Hiding& hiding,
               const std::vector<std::uint8_t>& visible) {
  if (layer.strokes.empty()) return;
  // What most strokes have in common stands once.
  document.add("<g stroke-width=\"{}\" stroke-opacity=\"{:.3g}\">\n",
               svg_units(2 * BrushProfile(layer.radius_px).middle_px), layer.strokes.front().opacity);
  for (std::size_t i = 0; i < layer.strokes.size(); ++i) {
    if (visible[i] == 0) continue;
    const Stroke& stroke = layer.strokes[i];
    const ClampedSpline spline(layer.points_of(stroke), stroke.reference_view);
    add_stroke(document, layer, stroke, seen_chains(spline, stroke.reference_view, view, hiding));
  }
  document.add("</g>\n");
}

void add_area(Document& document, const RegionPainting& painting, const RegionMark& mark, ViewPosition view) {
  document.add(R"(<path fill="#{0:02x}{1:02x}{2:02x}" stroke="#{0:02x}{1:02x}{2:02x}" d=")", mark.colour.r,
               mark.colour.g, mark.colour.b);
  for (const Ring& ring : painting.rings_of(mark)) {
    const auto points = painting.points_of(ring);
    const auto seen = [&](const ControlPoint& p) { return PlanePoint{x_in_view(p, mark.reference_view, view), p.y}; };
    document.move_to(seen(points.front()));
    for (const ControlPoint& point : points.subspan(1)) document.line_to(seen(point));
    document.close_ring();
  }
  document.add("\"/>\n");
}

/// Whether two colours would be told apart at a glance.
bool differs(Rgb8 a, Rgb8 b) {
  constexpr int noticeable = 12;
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > noticeable;
}

void add_line(Document& document, const DiffusionPainting& painting, const ColourLine& line, ViewPosition view) {
  const auto points = painting.points_of(line);
  const auto seen = [&](const ColourPoint& p) {
    return PlanePoint{x_in_view(p.at, line.reference_view, view), p.at.y};
  };
  for (std::size_t begin = 0; begin < points.size();) {
    std::size_t end = begin + 1;
    while (end < points.size() && !differs(points[begin].colour, points[end].colour)) ++end;
    const Rgb8 colour = points[(begin + end - 1) / 2].colour;
    document.add(R"(<path stroke="#{:02x}{:02x}{:02x}" d=")", colour.r, colour.g, colour.b);
    document.move_to(seen(points[begin]));
    // A piece ends where the next one begins.
    for (std::size_t i = begin + 1; i < std::min(end + 1, points.size()); ++i) document.line_to(seen(points[i]));
    document.end_line();
    document.add("\"/>\n");
    begin = end;
  }
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const auto byte = [&](std::size_t k) {
      return i + k < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i + k])) : 0u;
    };
    const unsigned three = byte(0) << 16 | byte(1) << 8 | byte(2);
    for (std::size_t k = 0; k < 4; ++k)
      text.push_back(i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=');
  }
  return text;
}

std::string svg_of(const StrokePainting& painting, ViewPosition view, const Hiding& hiding,
                   const std::string& /*ground_png*/) {
  Document document(painting.width, painting.height, R"(fill="none" stroke-linecap="round" stroke-linejoin="round")");
  const Rgb8 canvas = painting.canvas_colour;
  document.add("<rect width=\"100%\" height=\"100%\" fill=\"#{:02x}{:02x}{:02x}\"/>\n", canvas.r, canvas.g, canvas.b);
  // Two of an 8-bit value's steps.
  constexpr float hidden_share = 1.f / 128;
  const auto visible = visible_strokes(prepare_marks(painting), view, hiding, hidden_share);
  for (std::size_t i = 0; i < painting.layers.size(); ++i)
    add_layer(document, painting.layers[i], view, hiding, visible[i]);
  return document.finished();
}

std::string svg_of(const RegionPainting& painting, ViewPosition view, const Hiding& /*hiding*/,
                   const std::string& /*ground_png*/) {
  Document document(painting.width, painting.height, R"(fill-rule="evenodd" stroke-width="5" stroke-linejoin="round")");
  std::vector<const RegionMark*> marks;
  for (const RegionMark& mark : painting.marks)
    if (mark.views.contains(view)) marks.push_back(&mark);
  std::ranges::stable_sort(marks, {}, &RegionMark::disparity);
  for (const RegionMark* mark : marks) add_area(document, painting, *mark, view);
  return document.finished();
}

std::string svg_of(const DiffusionPainting& painting, ViewPosition view, const Hiding& /*hiding*/,
                   const std::string& ground_png) {
  Document document(painting.width, painting.height,
                    R"(fill="none" stroke-width="10" stroke-linecap="round" stroke-linejoin="round")");
  if (!ground_png.empty())
    document.add("<image width=\"100%\" height=\"100%\" xlink:href=\"data:image/png;base64,{}\"/>\n",
                 base64(ground_png));
  for (const ColourLine& line : painting.lines)
    if (line.views.contains(view)) add_line(document, painting, line, view);
  return document.finished();
}

}  // namespace

std::string svg_of(const Painting& painting, ViewPosition view, const std::string& ground_png) {
  const SeenSurfaces seen =
      seen_surfaces(PreparedSurfaces(painting.surfaces), view, width_of(painting), height_of(painting));
  return std::visit([&](const auto& marks) { return svg_of(marks, view, seen.hiding, ground_png); }, painting.marks);
}

}  // namespace wheatstone
