#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>

#include "wheatstone/app/film_depth.h"
#include "wheatstone/image/image.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

/// Where a frame is painted: 255, and 0 where it is not; what lies between mixes both. Of a frame's size.
struct FrameMask {
  Image<std::uint8_t> left;   ///< or of the one eye there is
  Image<std::uint8_t> right;  ///< empty: the left one, moved by the disparity
};

/// Gives the masks of a film's frames, which are asked for in their order, for a left eye's picture of their size.
using FilmMask = std::function<FrameMask(std::int64_t frame, const Image<Rgb8>& left)>;

/// Of a still picture, which holds for all frames, or of a film or numbered pictures: of the size of an eye, or of the
/// whole frames of the main film, in whose layout both eyes lie. Colours count as their mean. Throws Error{bad_input}
/// that names it where it is neither, or has not as many frames as the film; and while masks are asked for, where its
/// size fits neither.
FilmMask mask_of_film(const std::filesystem::path& mask, const MainFilm& main, StereoLayout layout);

/// The mask that a picture is, and the grey picture of a mask.
Image<std::uint8_t> mask_of_picture(const Image<Rgb8>& picture);
Image<Rgb8> picture_of_mask(const Image<std::uint8_t>& mask);

/// A mask of the left eye as the right eye sees it: each place moves by its disparity, the nearest is seen, and what
/// only the right eye sees goes on from the farther side. The disparity is finite.
Image<std::uint8_t> mask_in_right_eye(const Image<std::uint8_t>& left, ImageView<const float> left_disparity);

/// Shows `picture` where the mask is bright, and `outside` elsewhere. All are of one size.
void show_in_mask(const Image<std::uint8_t>& mask, const Image<Rgb8>& outside, Image<Rgb8>& picture);

}  // namespace wheatstone
