#include "wheatstone/drawing/svg.h"

#include "wheatstone/drawing/prepared_painting_internal.h"
#include "wheatstone/drawing/seen_surface_internal.h"

namespace wheatstone {

bool svg_has_ground(const Painting& painting) {
  return std::visit([](const auto& marks) { return svg_marks_have_ground(marks); }, painting.marks);
}

std::string svg_of(const Painting& painting, ViewPosition view, const std::string& ground_png) {
  const SeenSurfaces seen =
      seen_surfaces(Surfaces(painting.surfaces), view, {width_of(painting), 0, height_of(painting)});
  return std::visit([&](const auto& marks) { return svg_of_marks(marks, view, seen.hiding, ground_png); },
                    painting.marks);
}

}  // namespace wheatstone
