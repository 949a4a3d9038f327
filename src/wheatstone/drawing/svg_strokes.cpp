#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/drawing/svg.h"
#include "wheatstone/drawing/svg_document_internal.h"
#include "wheatstone/drawing/visible_strokes_internal.h"
#include "wheatstone/marks/spline.h"

namespace wheatstone {
namespace {

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

std::string hex_of(Rgb8 colour) { return fmt::format("#{:02x}{:02x}{:02x}", colour.r, colour.g, colour.b); }

Rgb8 colour_at_end(const Stroke& stroke) {
  const auto level = [](int from, int change) { return static_cast<std::uint8_t>(std::clamp(from + change, 0, 255)); };
  const auto& [r, g, b] = stroke.change;
  return {level(stroke.colour.r, r), level(stroke.colour.g, g), level(stroke.colour.b, b)};
}

/// The paint of a stroke: its colour, or a gradient from its first to its last point, which is added to the document.
std::string paint_of(const Stroke& stroke, const ClampedSpline& spline, ViewPosition view, int number,
                     SvgDocument& document) {
  const PlanePoint first = seen_from(spline.control(0), view);
  const PlanePoint last = seen_from(spline.control(spline.span_count() + 2), view);
  const Rgb8 end = colour_at_end(stroke);
  if (end == stroke.colour || (first.x == last.x && first.y == last.y)) return hex_of(stroke.colour);
  document.add(R"(<linearGradient id="s{}" gradientUnits="userSpaceOnUse" x1="{}" y1="{}" x2="{}" y2="{}">)"
               R"(<stop stop-color="{}"/><stop offset="1" stop-color="{}"/></linearGradient>)"
               "\n",
               number, svg_units(first.x), svg_units(first.y), svg_units(last.x), svg_units(last.y),
               hex_of(stroke.colour), hex_of(end));
  return fmt::format("url(#s{})", number);
}

void add_stroke(SvgDocument& document, const Layer& layer, const Stroke& stroke, const std::string& paint,
                std::span<const std::vector<PlanePoint>> chains) {
  document.add("<path stroke=\"{}\"", paint);
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

/// `number`: of the next stroke of the document; counts on.
void add_layer(SvgDocument& document, const Layer& layer, ViewPosition view, const Hiding& hiding,
               const std::vector<std::uint8_t>& visible, int& number) {
  if (layer.strokes.empty()) return;
  // Attributes that most strokes share are written once.
  document.add("<g stroke-width=\"{}\" stroke-opacity=\"{:.3g}\">\n",
               svg_units(2 * BrushProfile(layer.radius_px).middle_px), layer.strokes.front().opacity);
  for (std::size_t i = 0; i < layer.strokes.size(); ++i) {
    if (visible[i] == 0) continue;
    const Stroke& stroke = layer.strokes[i];
    const ClampedSpline spline(layer.points_of(stroke), stroke.reference_view);
    const std::vector<std::vector<PlanePoint>> chains = seen_chains(spline, stroke.reference_view, view, hiding);
    if (chains.empty()) continue;
    add_stroke(document, layer, stroke, paint_of(stroke, spline, view, number++, document), chains);
  }
  document.add("</g>\n");
}

}  // namespace

std::string svg_of_marks(const StrokePainting& painting, ViewPosition view, const Hiding& hiding,
                         const std::string& /*ground_png*/) {
  SvgDocument document(painting.width, painting.height,
                       R"(fill="none" stroke-linecap="round" stroke-linejoin="round")");
  const Rgb8 canvas = painting.canvas_colour;
  document.add("<rect width=\"100%\" height=\"100%\" fill=\"#{:02x}{:02x}{:02x}\"/>\n", canvas.r, canvas.g, canvas.b);
  // Two of an 8-bit value's steps.
  constexpr float hidden_share = 1.f / 128;
  const auto visible = visible_strokes(prepare_marks(painting), view, hiding, hidden_share);
  int number = 0;
  for (std::size_t i = 0; i < painting.layers.size(); ++i)
    add_layer(document, painting.layers[i], view, hiding, visible[i], number);
  return document.finished();
}

}  // namespace wheatstone
