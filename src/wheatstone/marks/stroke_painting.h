#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"
#include "wheatstone/marks/brush.h"

namespace wheatstone {

/// A point of a stroke's cubic B-spline: its place in the stroke's reference view, in pixels, and its disparity.
struct ControlPoint {
  float x = 0;
  float y = 0;
  float disparity = 0;
  friend bool operator==(const ControlPoint&, const ControlPoint&) = default;
};

/// What is added to a stroke's colour along it: nothing where it begins, all where it ends; levels, -255..255.
struct ColourChange {
  std::int16_t r = 0, g = 0, b = 0;
  friend bool operator==(const ColourChange&, const ColourChange&) = default;
};

/// What 8 bits leave out of a stroke's colour: added to it where the stroke begins and where it ends, in steps of
/// 1/128 level. Between, it changes evenly, as the colour does.
struct FineColour {
  static constexpr float steps_a_level = 128;
  std::array<std::int8_t, 3> begin{}, end{};  ///< red, green, blue
  friend bool operator==(const FineColour&, const FineColour&) = default;
};

/// One stroke of the brush: a disc with a soft rim, drawn along a cubic B-spline. It covers a pixel once, however
/// often its curve comes back to it.
struct Stroke {
  std::uint32_t first_point = 0;  ///< index into its layer's points
  std::uint32_t point_count = 0;  ///< at least one; a stroke of one point is a dot
  float radius_px = 0;
  float opacity = 1;
  Rgb8 colour;
  float disparity = 0;                     ///< the stroke's depth: the disparity of the point where it was begun
  ViewPosition reference_view = left_eye;  ///< the view in which its points stand
  ViewRange views;                         ///< in which it may be drawn, where no surface hides it
  std::uint32_t number = 0;                ///< names the stroke across the frames of a film, from 1; 0: none
  ColourChange change;
  bool is_part = false;  ///< of a stroke that another one of its layer begins, as the second half of a dual stroke
  FineColour fine = {};  ///< of paintings of pictures with more than 8 bits
  friend bool operator==(const Stroke&, const Stroke&) = default;
};

/// The strokes of one brush radius in the order in which they are drawn, far to near.
struct Layer {
  float radius_px = 0;
  std::vector<ControlPoint> points;
  std::vector<Stroke> strokes;

  std::span<const ControlPoint> points_of(const Stroke& stroke) const {
    return {points.data() + stroke.first_point, stroke.point_count};
  }
  friend bool operator==(const Layer&, const Layer&) = default;
};

/// Gives strokes without a number that of their place in the layer, which tells their bristles, too: the layer is drawn
/// as before, and what is left of it when others are taken away keeps its bristles.
inline void number_by_place(Layer& layer) {
  for (std::uint32_t place = 0; Stroke & stroke : layer.strokes) {
    if (stroke.number == 0) stroke.number = place;
    ++place;
  }
}

/// How many strokes people see: parts of one stroke count once.
inline std::size_t count_strokes(const Layer& layer) {
  return static_cast<std::size_t>(std::ranges::count(layer.strokes, false, &Stroke::is_part));
}

/// A painting as a value: made once, drawn for any view. Layers are drawn in their order, coarse to fine, over the
/// view's photograph or the canvas.
struct StrokePainting {
  static constexpr std::string_view marks_name = "strokes";
  int width = 0;  ///< of each view, in pixels
  int height = 0;
  Rgb8 canvas_colour{255, 255, 255};
  std::vector<Layer> layers;
  bool canvas_shows =
      true;     ///< false: without the photograph, thin paint is drawn opaque, and goes on where there is none
  Brush brush;  ///< of all layers; the coarsest, which is the ground of the others, does not run dry
  friend bool operator==(const StrokePainting&, const StrokePainting&) = default;
};

/// The column, in pixels, of a control point in another view: x(v) = x(ref) − (v − ref) · disparity.
inline float x_in_view(const ControlPoint& point, ViewPosition reference_view, ViewPosition view) {
  return point.x - (view - reference_view) * point.disparity;
}

}  // namespace wheatstone
