#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/curves/plan_diffusion.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/motion/steady_picture.h"

namespace wheatstone {

/// A point of an edge as it was drawn, with what lay on its two sides.
struct CarriedEdge {
  float x = 0, y = 0;                ///< in the pixels of its view
  float across_x = 0, across_y = 0;  ///< a unit vector from the second side to the first
  SampledColour colours[2];
  float disparities[2] = {0, 0};
  std::uint32_t view = 0;  ///< which of the scene's views
};

/// What one frame of a film hands to the next. Empty before the first.
struct DiffusionMemory {
  SteadyPicture picture;      ///< of the reference view, without grain
  Image<float> disparity;     ///< of the reference view
  Image<std::uint8_t> edges;  ///< of the reference view: 255 at its edges and beside them
  std::vector<CarriedEdge> points;
};

/// The edges of a frame of a film as diffusion curves, which move with what they are the edges of (Bukenberger et al.
/// 2015, sec. 3.1: what was found is carried along the optical flow and corrected). Edges are found in a picture that
/// is steadied along the flow; one that was drawn in the frame before stays until it is much fainter than a new one
/// must be; its place, colours and disparities approach what is found. Where the frame has no flow, or the memory is
/// of pictures of another size, the scene begins, and nothing is remembered. Throws Error as
/// plan_diffusion(views, style) does, and bad_input for flow of another size.
DiffusionPainting plan_diffusion(const FilmFrame& frame, const Style& style, DiffusionMemory& memory);

}  // namespace wheatstone
