#pragma once

#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/marks/diffusion_painting.h"
#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/surfaces.h"

namespace wheatstone {

/// How a painting's paint stands up from the canvas.
struct Relief {
  float depth_px = 0;       ///< height of 1; 0: no relief
  float bristle_px = 1.6f;  ///< width that a bristle leaves
  friend bool operator==(const Relief&, const Relief&) = default;
};

/// A painting: marks of one kind, and the surfaces that they lie on. Without surfaces nothing hides a mark, which is
/// then drawn in the views that it names.
struct Painting {
  std::variant<StrokePainting, RegionPainting, DiffusionPainting> marks;
  Surfaces surfaces;
  Relief relief;  ///< of strokes
  friend bool operator==(const Painting&, const Painting&) = default;
};

/// Size of the painting's pictures, in pixels.
int width_of(const Painting& painting);
int height_of(const Painting& painting);

/// The layers of a painting of strokes; none of any other.
std::span<const Layer> layers_of(const Painting& painting);

/// How many marks there are, and what they are called. A dual stroke is one mark.
struct MarkCount {
  std::string_view kind;  ///< "strokes", "regions" or "lines"
  std::size_t count = 0;
};
MarkCount count_marks(const Painting& painting);

/// How a painting is brought to pictures of another size.
struct Placement {
  int width = 0, height = 0;   ///< of the pictures; 0: the painting's own size, scaled
  double scale = 1;            ///< pixels of the pictures for one of the painting
  double left = 0, top = 0;    ///< place of the painting, in its own pixels, that comes to lie in the pictures' corner
  float zero_parallax_px = 0;  ///< disparity, in the painting's own pixels, that becomes 0
  friend bool operator==(const Placement&, const Placement&) = default;
};

/// The painting as it is to be drawn. A central view's place (x, y) comes to lie at scale · (x − left, y − top).
Painting placed(Painting painting, const Placement& placement);

/// Moves the marks that stand in one reference view to the right.
void shift_marks(ViewPosition reference_view, float by_px, Painting& painting);

/// How near each mark is, in no order: the disparities of strokes and regions, and of the points of curves. Marks
/// that mend what some views show of others do not count.
std::vector<float> disparities_of_marks(const Painting& painting);

}  // namespace wheatstone
