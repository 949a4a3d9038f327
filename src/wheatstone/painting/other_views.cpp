#include "wheatstone/painting/other_views.h"

#include <algorithm>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

constexpr ViewRange everywhere{ViewPosition(-1e6f), ViewPosition(1e6f)};

/// The marks that the eye nearest to a view sees, wherever that view is.
template <class Mark>
void show_as_nearest_eye(std::vector<Mark>& marks, ViewPosition view) {
  const ViewPosition eye = view > central_view ? right_eye : left_eye;
  std::erase_if(marks, [eye](const Mark& mark) { return !mark.views.contains(eye); });
  for (Mark& mark : marks) mark.views = everywhere;
}

/// Regions of one eye lie under those of both: shown from everywhere they come into sight where those uncover them.
DrawnView draw_regions(RegionPainting regions, ViewPosition view) {
  const bool of_both_eyes =
      std::ranges::any_of(regions.marks, [](const RegionMark& m) { return m.views == ViewRange{}; });
  if (of_both_eyes) {
    for (RegionMark& mark : regions.marks) mark.views = everywhere;
  } else {
    show_as_nearest_eye(regions.marks, view);
  }
  return draw(regions, view);
}

/// Between the eyes the lines of both bound what each eye alone sees. Beyond an eye, what the other one alone sees is
/// hidden.
DrawnView draw_curves(DiffusionPainting curves, ViewPosition view) {
  if (view > left_eye && view < right_eye) {
    for (ColourLine& line : curves.lines) line.views = everywhere;
  } else {
    show_as_nearest_eye(curves.lines, view);
  }
  return draw(curves, view);
}

}  // namespace

std::vector<DrawnView> draw_other_views(const Painting& painting, std::span<const ViewPosition> positions) {
  if (painting.regions.width == 0 && painting.curves.width == 0)
    throw Error(ErrorKind::wrong_usage, "the painting is of strokes, expected regions or curves");
  std::vector<DrawnView> views;
  for (const ViewPosition position : positions) {
    if (painting.regions.width > 0) {
      views.push_back(draw_regions(painting.regions, position));
    } else {
      views.push_back(draw_curves(painting.curves, position));
    }
  }
  return views;
}

}  // namespace wheatstone
