#pragma once

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/motion/steady_picture.h"

namespace wheatstone {

/// One colour of a palette, 0..255 a channel, finer than pixels have it.
struct PaletteColour {
  double red = 0, green = 0, blue = 0;
  friend bool operator==(const PaletteColour&, const PaletteColour&) = default;
};

/// What a posterised film remembers from one frame to the next; empty before the first.
struct PosterisedMemory {
  std::vector<PaletteColour> palette;
  Image<std::uint8_t> colour_of;  ///< of each pixel of the reference view: the index of its region's colour
  SteadyPicture picture;          ///< the reference view
};

/// A frame of a film as regions of few colours (Bukenberger et al. 2015, sec. 4.2): the pixels of the reference view
/// are clustered by k-means into `style.colours` colours, connected pixels of one colour and one surface become
/// a region. The reference view gives all views their regions; what only another view sees is cut there, into the same
/// colours. In the frames that follow the palette goes on from the frame before, slowly, and a pixel keeps its point's
/// colour, carried along the confirmed flow, unless another one is now clearly nearer. Throws Error: bad_input where
/// the views do not fit together, or the flow has not their size; wrong_usage for a style that cannot be painted with.
RegionPainting plan_posterised(const FilmFrame& frame, const Style& style, PosterisedMemory& memory);

}  // namespace wheatstone
