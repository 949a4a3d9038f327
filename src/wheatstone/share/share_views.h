#pragma once

#include <span>
#include <string>

#include "wheatstone/image/image.h"
#include "wheatstone/share/page.h"

namespace wheatstone {

/// Ready views, from the leftmost to the rightmost, for a page, which shows the nearest to where somebody looks from.
/// They are made smaller where no browser could hold all of them, in one picture of 8192 × 8192 pixels.
/// Throws Error{wrong_usage} where there are none, or they are of different sizes.
SharedPicture share_views(std::span<const Image<Rgb8>> views, const std::string& title);

}  // namespace wheatstone
