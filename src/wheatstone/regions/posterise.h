#pragma once

#include "wheatstone/marks/region_painting.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/motion/film_frame.h"
#include "wheatstone/motion/steady_picture.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A pair as regions of few colours (Bukenberger et al. 2015, sec. 4.2): the pixels are clustered in RGB by k-means
/// into `style.colours` colours, connected pixels of one colour and one surface become a region. Both eyes show the
/// regions of the left one; what only the right eye sees is cut there, into the same colours. Throws Error: bad_input
/// where the geometry does not fit, wrong_usage for a style that cannot be painted with.
RegionPainting plan_posterised(const StereoPairView& photographs, const StereoGeometryView& geometry,
                               const Style& style);

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

/// The next frame of a film, posterised: the palette goes on from the frame before, slowly, and a pixel keeps its
/// point's colour, carried along the confirmed flow, unless another one is now clearly nearer. The reference view gives
/// all views their regions; what only another view sees is cut there, into the same colours. Throws Error as above, and
/// bad_input where the flow has not the views' size.
RegionPainting plan_posterised(const FilmFrame& frame, const Style& style, PosterisedMemory& memory);

}  // namespace wheatstone
