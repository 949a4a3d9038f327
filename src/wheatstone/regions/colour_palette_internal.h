#pragma once

#include <vector>

#include "wheatstone/image/image.h"
#include "wheatstone/regions/posterise.h"

namespace wheatstone {

/// The colours that represent those of a picture best: k-means by unlikeness, begun as k-means++ (Arthur &
/// Vassilvitskii 2007), then changed so that few pixels have a colour that is like none of them. At most `count`; fewer
/// where the picture has fewer. The same for the same seed.
std::vector<PaletteColour> find_palette(ImageView<const Rgb8> picture, int count, std::uint64_t seed);

/// How many of a style's colours are found so. The others are left for small things whose colours are like none of them
/// (regions/repair.h).
constexpr int palette_size(int colours) {
  constexpr int ninths = 2;
  return colours - colours * ninths / 9;
}

/// Moves a palette towards the colours of the film's next picture: a few rounds of k-means from where it is, of which
/// each colour takes a share, so that colours never jump.
void follow_palette(ImageView<const Rgb8> picture, std::vector<PaletteColour>& palette);

std::vector<Rgb8> rounded(const std::vector<PaletteColour>& palette);

/// Squared distance in RGB.
int squared_distance(Rgb8 a, Rgb8 b);

/// How unlike two colours are, as a squared distance in RGB, but with differences of hue and saturation counting
/// more than those of luminance: a poster's shades may be off, its skin may not be grey.
float unlikeness(Rgb8 a, Rgb8 b);

/// The index of the palette's colour that is least unlike; the palette is not empty.
std::size_t nearest_colour(const std::vector<Rgb8>& palette, Rgb8 colour);

}  // namespace wheatstone
