#include <array>
#include <utility>

#include "wheatstone/share/mark_parts_internal.h"
#include "wheatstone/share/number_streams_internal.h"

namespace wheatstone {

PagePart regions_part(std::string name, const RegionPainting& painting, const Rounding& rounding, Plans& plans) {
  std::array<NumberStream, 9> streams;
  auto& [ring_counts, point_counts, x, y, disparities, green, red, blue, numbers] = streams;
  std::array<std::int64_t, 3> last{};
  const auto add_place = [&](std::size_t axis, float place, NumberStream& to) {
    const std::int64_t here = in_steps(place, rounding.steps_a_px);
    to.add_signed(here - last[axis]);
    last[axis] = here;
  };
  for (const RegionMark& mark : painting.marks) {
    ring_counts.add_whole(mark.ring_count);
    numbers.add_whole(plans.number_of({mark.reference_view, mark.views}));
    green.add_signed(mark.colour.g);
    red.add_signed(mark.colour.r - mark.colour.g);
    blue.add_signed(mark.colour.b - mark.colour.g);
    for (const Ring& ring : painting.rings_of(mark)) {
      point_counts.add_whole(ring.point_count);
      for (const ControlPoint& point : painting.points_of(ring)) {
        add_place(0, point.x, x);
        add_place(1, point.y, y);
        add_place(2, point.disparity, disparities);
      }
    }
  }
  return part_of_streams(std::move(name), streams);
}

}  // namespace wheatstone
