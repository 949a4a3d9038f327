#pragma once

#include "wheatstone/strokes/layer_planner.h"

namespace wheatstone {

/// 255 where a canvas is bare, as far as it is wanted: `wanted` is not 0 there, or empty.
Image<std::uint8_t> bare_pixels(const Canvas& canvas, ImageView<const std::uint8_t> wanted);

/// The strokes of a layer that may cover something bare; they stand in the mask's view.
Layer strokes_near_bare(const Layer& layer, ImageView<const std::uint8_t> bare);

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

/// The same for the bare pixels of a planner's view. `inputs` are the finest layer's.
Layer cover_bare(const LayerPlanner& planner, const LayerInputs& inputs, const ScaledStyle& scaled, const Style& style,
                 Image<std::uint8_t> bare);

}  // namespace wheatstone
