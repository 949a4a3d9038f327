#include <algorithm>
#include <cstdlib>
#include <string_view>

#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/svg_document_internal.h"
#include "wheatstone/files/text_encoding.h"

namespace wheatstone {
namespace {

/// Whether two colours would be told apart at a glance.
bool differs(Rgb8 a, Rgb8 b) {
  constexpr int noticeable = 12;
  return std::max({std::abs(a.r - b.r), std::abs(a.g - b.g), std::abs(a.b - b.b)}) > noticeable;
}

void add_line(SvgDocument& document, const DiffusionPainting& painting, const ColourLine& line, ViewPosition view) {
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

}  // namespace

std::string svg_of_marks(const DiffusionPainting& painting, ViewPosition view, const Hiding& /*hiding*/,
                         const std::string& ground_png) {
  SvgDocument document(painting.width, painting.height,
                       R"(fill="none" stroke-width="10" stroke-linecap="round" stroke-linejoin="round")");
  if (!ground_png.empty())
    document.add("<image width=\"100%\" height=\"100%\" xlink:href=\"data:image/png;base64,{}\"/>\n",
                 base64(ground_png));
  for (const ColourLine& line : painting.lines)
    if (line.views.contains(view)) add_line(document, painting, line, view);
  return document.finished();
}

}  // namespace wheatstone
