#pragma once

#include <span>
#include <vector>

#include "wheatstone/curves/carried_edges_internal.h"
#include "wheatstone/curves/plan_diffusion.h"

namespace wheatstone {

/// A scene whose edges become lines, the reference view first: pictures without grain, disparities without outliers,
/// and what is wanted of each view, grown.
struct SceneOfEdges {
  std::vector<View> views;
  float depth_threshold_px = 2;
};

/// Throws Error as plan_diffusion(views, style) does.
SceneOfEdges scene_of_edges(std::span<const View> views, const Style& style);

/// The lines of all views, in pixels of the reference view, and the edges that they lie beside, in those of their own.
/// `before` is null where nothing is remembered.
struct LinesAndEdges {
  DiffusionPainting painting;
  std::vector<CarriedEdge> edges;
};
LinesAndEdges lines_beside_edges(const SceneOfEdges& scene, const CarriedEdges* before);

}  // namespace wheatstone
