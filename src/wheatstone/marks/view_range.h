#pragma once

#include "wheatstone/depth/view_position.h"

namespace wheatstone {

/// View positions, both ends included; those of the eyes and between them unless told.
struct ViewRange {
  ViewPosition first = left_eye;
  ViewPosition last = right_eye;
  constexpr bool contains(ViewPosition view) const { return view >= first && view <= last; }
  friend bool operator==(const ViewRange&, const ViewRange&) = default;
};

/// From any view: what hides a mark that may be drawn everywhere are the surfaces before it.
inline constexpr ViewRange all_views{ViewPosition(-1e6f), ViewPosition(1e6f)};

}  // namespace wheatstone
