#pragma once

#include <optional>
#include <string>
#include <utility>

#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Takes a picture of this layout apart, into eyes with square pixels: halves are brought back to full size (Lanczos);
/// in rows, columns and checkerboards the pixels that are there stay, and the others become the mean of their
/// neighbours. Throws Error{bad_input} that names the picture as `name` where it cannot be halved evenly,
/// Error{wrong_usage} where the layout does not hold both eyes in one picture.
StereoPair cut_apart(ImageView<const Rgb8> picture, StereoLayout layout, const std::string& name);
/// The same of a picture with 16 bits a channel; the left eye comes first.
std::pair<Image<Rgb16>, Image<Rgb16>> cut_apart(ImageView<const Rgb16> picture, StereoLayout layout,
                                                const std::string& name);

/// The picture without its middle column where it is to be cut between columns and has an odd number of them; the same
/// for rows. Nothing where it can be halved evenly as it is, or is not halved.
std::optional<Image<Rgb8>> without_middle(ImageView<const Rgb8> picture, StereoLayout layout);

/// Packs two pictures of one size into one. This is the inverse of cut_apart, and exact if nothing is squeezed.
/// Squeezing averages the pixels that become one; the last of an odd number stays alone. Rows, columns and
/// checkerboards take from each eye the pixels at its places, which are the screen's own pixels: scale the pictures
/// before. Mono gives the left picture. Throws Error{wrong_usage} where the sizes differ, and for layouts in time.
Image<Rgb8> put_together(ImageView<const Rgb8> left, ImageView<const Rgb8> right, StereoLayout layout);
Image<Rgb16> put_together(ImageView<const Rgb16> left, ImageView<const Rgb16> right, StereoLayout layout);

}  // namespace wheatstone
