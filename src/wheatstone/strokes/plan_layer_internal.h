#pragma once

#include <span>

#include "wheatstone/drawing/canvas.h"
#include "wheatstone/marks/stroke_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/strokes/outline_disparity.h"
#include "wheatstone/strokes/reference_picture.h"

namespace wheatstone {

/// Beyond the brush's radius, distances to depth edges are known up to here.
inline constexpr float known_edge_distance_px = 3;

/// What one layer of one view is planned from; everything has the view's size.
struct LayerPlan {
  const ReferencePicture& reference;
  const Canvas& canvas;                     ///< as the coarser layers left it
  ImageView<const float> disparity;         ///< pixels, no unknowns
  ImageView<const std::uint8_t> seeds;      ///< strokes begin only where it is not 0; empty: everywhere
  ImageView<const std::uint8_t> misplaced;  ///< strokes are wanted first where it is not 0; empty: nowhere
  ViewPosition view = left_eye;
  float radius_px = 4;
  int layer = 0;            ///< numbers the layer's random choices
  ViewsBeside beside = {};  ///< from which its strokes will be seen
  float least_gain = 0;     ///< by which a fitted stroke must lower the squared differences under it

  // The depth test; all are empty where the style wants none.
  float depth_threshold_px = 2;                    ///< T_depth in pixels of this view
  float least_edge_cell_px = 1;                    ///< of the grid beside depth edges
  ImageView<const std::uint8_t> depth_edges = {};  ///< as near_depth_edge
  ImageView<const float> edge_distance = {};  ///< as distance_to_depth_edge; empty: leave the edges to a finer layer
  ImageView<const std::uint8_t> mixed_colours = {};  ///< as behind_depth_edge: no stroke takes its colour there
};

/// Plans the strokes of one layer (Hertzmann 1998; Stavrakis & Gelautz 2004, sec. 3.2 and 3.3): one for every grid cell
/// whose largest error, over the cell, is above the threshold, or that has misplaced paint. Beside depth edges, where
/// the brush does not fit, it is used edgeways: on a grid of half the cells, strokes as wide as the distance to the
/// edge allows. In the order of the cells, not yet in drawing order.
Layer plan_layer(const LayerPlan& plan, const Style& style);

/// Plans the strokes of one layer by fitting each to the picture, on a canvas that holds those before it. A stroke is
/// kept if it lowers the squared difference between picture and canvas enough. Cells of 1.3 R are visited in two
/// passes; in each, the pixel that is most wrong begins a stroke. The picture is divided into blocks, which are planned
/// in four waves, so that the result does not depend on threads. In drawing order.
Layer fit_layer(const LayerPlan& plan, const Style& style);

/// Smooths the disparities of a stroke's points, and in the finest layer keeps its paint within its surface's outline.
void settle_disparities(const LayerPlan& plan, float radius_px, std::span<ControlPoint> points);

}  // namespace wheatstone
