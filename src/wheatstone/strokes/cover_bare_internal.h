#pragma once

#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {

/// The strokes of a layer that may cover something of a canvas that is bare; they stand in the canvas's view.
Layer strokes_near_bare(const Layer& layer, const Canvas& canvas);

/// What is to be covered: a view, and its pixels that are bare. Where `mixed_colours` is not 0, the photograph mixes
/// the colours of two surfaces; it may be empty.
struct BarePlaces {
  ImageView<const Rgb8> photograph;
  ImageView<const float> disparity;
  ViewPosition view;
  ImageView<const std::uint8_t> mixed_colours;
  Image<std::uint8_t> bare;
  float least_dot_px = 1;  ///< radius
};

/// Dots and short threads of the photograph's colours for the bare pixels, row by row. Each lies on one surface and has
/// that surface's colour.
Layer cover_places(BarePlaces places, const ScaledStyle& scaled, const Style& style);

/// The same for the pixels of a planner's canvas that no stroke covers, as far as they are wanted: `wanted` is not 0
/// there, or empty. `inputs` are the finest layer's.
Layer cover_bare(const LayerPlanner& planner, const LayerInputs& inputs, const ScaledStyle& scaled, const Style& style,
                 ImageView<const std::uint8_t> wanted);

}  // namespace wheatstone
