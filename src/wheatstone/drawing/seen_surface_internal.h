#pragma once

#include <span>
#include <vector>

#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/surfaces.h"

namespace wheatstone {

/// A painting's surfaces, and the runs of columns in which each row of them is known.
struct PreparedSurfaces {
  explicit PreparedSurfaces(Surfaces surfaces);

  struct Run {
    int begin, end;
  };
  std::span<const Run> runs_of(std::size_t surface, int y) const {
    const std::vector<std::size_t>& first = first_run[surface];
    const auto row = static_cast<std::size_t>(y);
    return std::span(runs[surface]).subspan(first[row], first[row + 1] - first[row]);
  }

  Surfaces surfaces;
  std::vector<std::vector<Run>> runs;               ///< of each surface, row by row
  std::vector<std::vector<std::size_t>> first_run;  ///< of each row, and one more
};

/// What hides a painting's marks in one view.
struct SeenSurfaces {
  Image<float> nearest, reference, photographed;
  Hiding hiding;  ///< refers to them
};

/// Empty where the painting has no surfaces.
SeenSurfaces seen_surfaces(const PreparedSurfaces& surfaces, ViewPosition view, int width, int height);

}  // namespace wheatstone
