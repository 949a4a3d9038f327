#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>

#include "wheatstone/display/quilt.h"
#include "wheatstone/image/image.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/share/page.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/stereo/stereo_pair.h"
#include "wheatstone/stereo/view.h"

namespace wheatstone {

struct SharePaintingOptions {
  std::string title;
  std::optional<std::size_t> most_bytes;  ///< of the page; by default 1.5 MB for 640 × 480 pixels, more for more pixels
};

/// A painting for a page, which draws its marks for any view. Places of marks are rounded to an eighth of a pixel, or
/// where the page would be larger than is wanted, to a quarter or half of one, and colours to
/// two or four levels; where `most_bytes` are still too few, the picture becomes smaller. What hides marks is rounded
/// to a quarter of a pixel of disparity, and strokes that no view shows are left out. Throws Error{bad_input} where the
/// page cannot draw it.
SharedPicture share_painting(const Painting& painting, const SharePaintingOptions& options);

struct ShareFilmOptions {
  std::string title;
  std::filesystem::path page = "page.html";  ///< where the page will stand, from which a film beside it is found
  std::optional<StereoLayout> layout;        ///< by default what the film says, or lets guess
  std::optional<QuiltLayout> quilt;          ///< each frame is a quilt
  std::filesystem::path subtitles;           ///< a WebVTT file; empty: none
  std::size_t most_bytes = 32'000'000;       ///< of the page; a film that is larger stays beside it
};

/// A film of both eyes, or of quilts, for a page that plays it as it is: frames are not coded again. Throws
/// Error{bad_input} where browsers cannot play such files, or its layout cannot be shown by a page.
SharedPicture share_film(const std::filesystem::path& film, const ShareFilmOptions& options);

/// A photograph of two views, or of one and its depth (stereo/single_view.h), for a page: its pictures on the surfaces
/// that they show, and for views beside the eyes what `make_still_scene` continues, or what `known` views show.
SharedPicture share_photograph(const StereoPair& photographs, const StereoGeometry& geometry, const std::string& title,
                               std::span<const View> known = {});

/// The views that a page of a photograph can be seen from.
inline constexpr ViewRange shared_views{ViewPosition(-1.f), ViewPosition(1.f)};

/// Ready views, from the leftmost to the rightmost, for a page, which shows the nearest to where somebody looks from.
/// They are made smaller where no browser could hold all of them, in one picture of 8192 × 8192 pixels.
/// Throws Error{wrong_usage} where there are none, or they are of different sizes.
SharedPicture share_views(std::span<const Image<Rgb8>> views, const std::string& title);

struct ShareSlicesOptions {
  std::string title;
  std::size_t most_bytes = 8'000'000;  ///< of the page
};

/// Slices for a page, which moves and adds them for any view, as `render_slices` does. Light is rounded to 255 steps of
/// a logarithm; where the page would be larger than is wanted, to 127 or 63 of them, and then in pictures of half the
/// width and height, and so on. Throws Error{bad_input} where there are no slices.
SharedPicture share_slices(SliceStack stack, const ShareSlicesOptions& options);

}  // namespace wheatstone
