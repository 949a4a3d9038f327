#include "wheatstone/drawing/svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/marks/spline.h"

namespace wheatstone {
namespace {

using Text = fmt::memory_buffer;

template <class... Values>
void add(Text& text, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
}

PlanePoint blend(PlanePoint a, float weight_a, PlanePoint b, float weight_b) {
  return {weight_a * a.x + weight_b * b.x, weight_a * a.y + weight_b * b.y};
}

/// A uniform B-spline's span with controls p0 … p3 is the Bézier curve with inner points (2p1 + p2)/3 and
/// (p1 + 2p2)/3 that ends at (p1 + 4p2 + p3)/6.
void add_spline(Text& text, const ClampedSpline& spline) {
  const PlanePoint begin = spline.control(0);
  add(text, "M{:.2f} {:.2f}", begin.x, begin.y);
  if (spline.span_count() == 0) add(text, "h0");
  for (int span = 0; span < spline.span_count(); ++span) {
    const PlanePoint p1 = spline.control(span + 1), p2 = spline.control(span + 2), p3 = spline.control(span + 3);
    const PlanePoint first = blend(p1, 2.f / 3, p2, 1.f / 3), second = blend(p1, 1.f / 3, p2, 2.f / 3);
    const PlanePoint outer = blend(p1, 1.f / 6, p3, 1.f / 6);
    const PlanePoint end = blend(outer, 1, p2, 4.f / 6);
    add(text, "C{:.2f} {:.2f} {:.2f} {:.2f} {:.2f} {:.2f}", first.x, first.y, second.x, second.y, end.x, end.y);
  }
}

void add_layer(Text& text, const Layer& layer, ViewPosition view) {
  add(text, "<g stroke-width=\"{:.2f}\">\n", 2 * BrushProfile(layer.radius_px).middle_px);
  for (const Stroke& stroke : layer.strokes) {
    if (!stroke.views.contains(view)) continue;
    add(text, "<path stroke=\"#{:02x}{:02x}{:02x}\"", stroke.colour.r, stroke.colour.g, stroke.colour.b);
    if (stroke.radius_px != layer.radius_px)
      add(text, " stroke-width=\"{:.2f}\"", 2 * BrushProfile(stroke.radius_px).middle_px);
    if (stroke.opacity < 1) add(text, " stroke-opacity=\"{:.3g}\"", stroke.opacity);
    add(text, " d=\"");
    add_spline(text, ClampedSpline(layer.points_of(stroke), stroke.reference_view, view));
    add(text, "\"/>\n");
  }
  add(text, "</g>\n");
}

void add_area(Text& text, const RegionPainting& painting, const RegionMark& mark, ViewPosition view) {
  add(text, R"(<path fill="#{0:02x}{1:02x}{2:02x}" stroke="#{0:02x}{1:02x}{2:02x}" d=")", mark.colour.r, mark.colour.g,
      mark.colour.b);
  for (const Ring& ring : painting.rings_of(mark)) {
    char command = 'M';
    for (const ControlPoint& point : painting.points_of(ring)) {
      add(text, "{}{:.2f} {:.2f}", command, x_in_view(point, mark.reference_view, view), point.y);
      command = 'L';
    }
    add(text, "Z");
  }
  add(text, "\"/>\n");
}

void add_line(Text& text, const DiffusionPainting& painting, const ColourLine& line, ViewPosition view) {
  const auto points = painting.points_of(line);
  std::size_t red = 0, green = 0, blue = 0;
  for (const ColourPoint& point : points) {
    red += point.colour.r;
    green += point.colour.g;
    blue += point.colour.b;
  }
  add(text, R"(<path stroke="#{:02x}{:02x}{:02x}" d=")", red / points.size(), green / points.size(),
      blue / points.size());
  char command = 'M';
  for (const ColourPoint& point : points) {
    add(text, "{}{:.2f} {:.2f}", command, x_in_view(point.at, line.reference_view, view), point.at.y);
    command = 'L';
  }
  if (points.size() == 1) add(text, "h0");
  add(text, "\"/>\n");
}

}  // namespace

std::string svg_of(const StrokePainting& painting, ViewPosition view) {
  Text text;
  add(text,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" fill=\"none\" "
      "stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      painting.width, painting.height);
  const Rgb8 canvas = painting.canvas_colour;
  add(text, "<rect width=\"100%\" height=\"100%\" fill=\"#{:02x}{:02x}{:02x}\"/>\n", canvas.r, canvas.g, canvas.b);
  for (const Layer& layer : painting.layers) add_layer(text, layer, view);
  add(text, "</svg>\n");
  return fmt::to_string(text);
}

std::string svg_of(const RegionPainting& painting, ViewPosition view) {
  Text text;
  add(text,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" "
      "fill-rule=\"evenodd\" stroke-width=\"0.5\" stroke-linejoin=\"round\">\n",
      painting.width, painting.height);
  std::vector<const RegionMark*> marks;
  for (const RegionMark& mark : painting.marks)
    if (mark.views.contains(view)) marks.push_back(&mark);
  std::ranges::stable_sort(marks, {}, &RegionMark::disparity);
  for (const RegionMark* mark : marks) add_area(text, painting, *mark, view);
  add(text, "</svg>\n");
  return fmt::to_string(text);
}

std::string svg_of(const DiffusionPainting& painting, ViewPosition view) {
  Text text;
  add(text,
      "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" viewBox=\"0 0 {0} {1}\" fill=\"none\" "
      "stroke-width=\"1\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n",
      painting.width, painting.height);
  for (const ColourLine& line : painting.lines)
    if (line.views.contains(view)) add_line(text, painting, line, view);
  add(text, "</svg>\n");
  return fmt::to_string(text);
}

std::string svg_of(const Painting& painting, ViewPosition view) {
  if (painting.regions.width > 0) return svg_of(painting.regions, view);
  if (painting.curves.width > 0) return svg_of(painting.curves, view);
  return svg_of(painting.painting, view);
}

void write_svg(const std::filesystem::path& path, const Painting& painting, ViewPosition view) {
  write_whole_file(path, svg_of(painting, view));
}

}  // namespace wheatstone
