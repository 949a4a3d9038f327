#pragma once

#include <array>
#include <string>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// Brings colours that an ICC profile describes to sRGB, relative colorimetric with black point compensation. Leaves
/// the picture alone where there is no profile, it is damaged, describes other channels (a print's CMYK, which was
/// converted already), or says sRGB but for rounding. `grey`: the picture came with one channel.
void bring_to_srgb(Image<Rgb8>& picture, std::string_view profile, bool grey);
void bring_to_srgb(Image<Rgb16>& picture, std::string_view profile, bool grey);

/// Whether colours of three channels that the profile describes are others than sRGB's: then bring_to_srgb changes
/// them.
bool describes_other_colours(std::string_view profile);

/// An ICC profile of colours that are coded by sRGB's curve and have other primaries: CIE x and y of red, green, blue
/// and white.
std::string profile_with_primaries(const std::array<std::array<double, 2>, 4>& primaries);

/// The ICC profile in the bytes of a PNG (chunk iCCP), WebP (chunk ICCP) or HEIF file, whose decoders do not hand it
/// on; empty where there is none, or a damaged one, and for all other kinds of file.
std::string embedded_profile(std::string_view bytes);

}  // namespace wheatstone
