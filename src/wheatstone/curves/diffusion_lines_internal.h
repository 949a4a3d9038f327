#pragma once

#include <span>
#include <vector>

#include "wheatstone/curves/carried_edges_internal.h"
#include "wheatstone/curves/plan_diffusion.h"

namespace wheatstone {

/// A view of a scene, made ready for finding its edges.
struct ViewOfEdges {
  Image<Rgb8> picture;            ///< without grain
  Image<float> disparity;         ///< without outliers
  Image<std::uint8_t> only_here;  ///< what the reference view does not show, grown; empty: all is wanted
  ViewPosition position;
};

/// A scene whose edges become lines, the reference view first.
struct SceneOfEdges {
  std::vector<ViewOfEdges> views;
  float depth_threshold_px = 2;
};

/// Throws Error as plan_diffusion(views, style) does.
SceneOfEdges scene_of_edges(std::span<const SceneView> views, const Style& style);

/// The lines of all views, and the edges that they lie beside. `before` is null where nothing is remembered.
struct LinesAndEdges {
  DiffusionPainting painting;
  std::vector<CarriedEdge> edges;
};
LinesAndEdges lines_beside_edges(const SceneOfEdges& scene, const CarriedEdges* before);

}  // namespace wheatstone
