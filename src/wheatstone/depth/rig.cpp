#include "wheatstone/depth/rig.h"

#include <fmt/format.h>
#include <unistd.h>

namespace wheatstone {

Rig evenly_spaced(int width, int height, int count, float span) {
  check_number("views", count, view_count_range);
  check_number("span", span, view_span_range);
  Rig rig{.width = width, .height = height, .positions = {}};
  for (int i = 0; i < count; ++i)
    rig.positions.emplace_back(count > 1 ? span * (static_cast<float>(i) / static_cast<float>(count - 1) - 0.5f) : 0.f);
  return rig;
}

void check_views_fit(const Rig& rig) {
  if (!view_side_range.has(rig.width) || !view_side_range.has(rig.height))
    throw Error(ErrorKind::wrong_usage, fmt::format("size: is {}x{} pixels, expected sides{}", rig.width, rig.height,
                                                    words_of(view_side_range)));
  constexpr double gigabyte = 1e9;
  const double taken = 3. * rig.width * rig.height * static_cast<double>(rig.positions.size());
  const double memory = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  if (taken > memory)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{} views of {}x{} pixels take {:.0f} GB, expected less than the memory of this computer, "
                            "{:.0f} GB",
                            rig.positions.size(), rig.width, rig.height, taken / gigabyte, memory / gigabyte));
}

}  // namespace wheatstone
