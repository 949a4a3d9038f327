#include <algorithm>
#include <vector>

#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/svg_document_internal.h"

namespace wheatstone {
namespace {

void add_area(SvgDocument& document, const RegionPainting& painting, const RegionMark& mark, ViewPosition view) {
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

}  // namespace

std::string svg_of_marks(const RegionPainting& painting, ViewPosition view, const Hiding& /*hiding*/,
                         const std::string& /*ground_png*/) {
  SvgDocument document(painting.width, painting.height,
                       R"(fill-rule="evenodd" stroke-width="5" stroke-linejoin="round")");
  std::vector<const RegionMark*> marks;
  for (const RegionMark& mark : painting.marks)
    if (mark.views.contains(view)) marks.push_back(&mark);
  std::ranges::stable_sort(marks, {}, &RegionMark::disparity);
  for (const RegionMark* mark : marks) add_area(document, painting, *mark, view);
  return document.finished();
}

}  // namespace wheatstone
