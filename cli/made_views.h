#pragma once

#include "command.h"
#include "depth_argument.h"
#include "packing.h"
#include "views_argument.h"

namespace wheatstone::cli {

/// Views of a photograph that it does not hold: of one picture with its depth, or between and beside those of a pair,
/// which is matched. All but the depth belongs to the caller.
struct MadeViews {
  const ViewsArguments& input;
  const PackingArguments& packing;
  const DepthArguments& depth;
  const Given& given;
  float zero_parallax_px = 0;  ///< where it was given
  int max_size = 0;
};

/// Whether the one file has its own depth, or is given it.
bool has_own_depth(const ViewsArguments& input, const DepthArguments& depth);

/// A photograph's two views with their geometry, and where they come from.
struct MeasuredPhotograph {
  StereoPair pictures;
  StereoGeometry geometry;
  std::string how;
};

/// Reads it with its own depth, or rectifies and matches the pair. Throws Error as read_photographs and
/// read_single_picture.
MeasuredPhotograph measure_photograph(const MadeViews& wanted, const Session& session);

/// How many views the packing takes of a photograph; 2 where it takes what there is.
int views_of_photograph(const ViewsArguments& input, const Packing& packing, const PackingArguments& arguments);

/// Whether views are made. What is typed may not fit together yet.
bool makes_views(const ViewsArguments& input, const Packing& packing, const PackingArguments& arguments,
                 const DepthArguments& depth);

/// Makes them, of the display's size where one is named, and else of the photograph's. Throws Error as
/// read_photographs, read_single_picture and draw_photograph_views.
ReadViews make_views(const MadeViews& wanted, const Packing& packing, const Session& session);

}  // namespace wheatstone::cli
