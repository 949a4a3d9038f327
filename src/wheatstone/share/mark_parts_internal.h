#pragma once

#include <string>
#include <vector>

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/share/page.h"

namespace wheatstone {

/// A mark's reference view and the views in which it may be drawn.
struct Planned {
  ViewPosition reference;
  ViewRange views;
  friend bool operator==(const Planned&, const Planned&) = default;
};

/// The kinds of planning that a painting's marks have, in the order in which they were met.
class Plans {
 public:
  std::size_t number_of(const Planned& planned);
  const std::vector<Planned>& all() const { return plans_; }

 private:
  std::vector<Planned> plans_;
};

/// To what a page rounds what it tells of marks.
struct Rounding {
  int steps_a_px = 8;   ///< of places; twice as many of the disparities of strokes, which move them
  int colour_step = 1;  ///< in levels of 256
};

/// Whether the paint of some strokes is not the same everywhere: they have bristles, or their colours change.
bool strokes_vary(const StrokePainting& painting);

/// A layer's strokes, in few bytes; `vary`: with their numbers, and the changes of their colours. page/chains.ts reads
/// them.
PagePart strokes_part(std::string name, const Layer& layer, bool vary, const Rounding& rounding, Plans& plans);

/// Regions in their order; colours are not rounded, as there are few. page/regions.ts reads them.
PagePart regions_part(std::string name, const RegionPainting& painting, const Rounding& rounding, Plans& plans);

}  // namespace wheatstone
