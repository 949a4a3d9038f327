#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "wheatstone/marks/painting.h"
#include "wheatstone/share/page.h"

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

}  // namespace wheatstone
