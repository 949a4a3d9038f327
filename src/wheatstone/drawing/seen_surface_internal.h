#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/drawing/hiding.h"
#include "wheatstone/marks/surfaces.h"

namespace wheatstone {

/// A painting's surfaces, reduced to their runs of known pixels.
class PreparedSurfaces {
 public:
  /// A run of columns of a row, and where its disparities begin.
  struct Run {
    int begin, end;
    std::size_t first_value;
  };
  struct KnownPart {
    ViewPosition view;
    int left_px;
    bool continued;
    std::vector<Run> runs;               ///< row by row
    std::vector<std::size_t> first_run;  ///< index of each row's first run, and the end
    std::vector<float> disparities;

    int rows() const { return static_cast<int>(first_run.size()) - 1; }
    std::span<const Run> runs_of(int y) const {
      const auto row = static_cast<std::size_t>(y);
      return std::span(runs).subspan(first_run[row], first_run[row + 1] - first_run[row]);
    }
    std::span<const float> disparities_of(const Run& run) const {
      return std::span(disparities).subspan(run.first_value, static_cast<std::size_t>(run.end - run.begin));
    }
  };

  explicit PreparedSurfaces(const Surfaces& surfaces);

  std::vector<KnownPart> seen;  ///< the reference view's first
  float tolerance_px;
  ViewRange photographed;
};

/// Where a mark was planned, which decides what surfaces may hide it.
enum class PlannedIn : std::uint8_t { reference_view, photographed_view, other_view };
PlannedIn kind_of(ViewPosition planned_in, const PreparedSurfaces& surfaces);

/// What hides a painting's marks in some rows of one view.
struct SeenSurfaces {
  Image<float> nearest, reference, photographed;
  Hiding hiding;  ///< refers to these images
};

/// Some rows of a view.
struct RowsOfView {
  int width;
  int first_row, row_count;
};

/// Empty where the painting has no surfaces.
SeenSurfaces seen_surfaces(const PreparedSurfaces& surfaces, ViewPosition view, const RowsOfView& rows);

}  // namespace wheatstone
