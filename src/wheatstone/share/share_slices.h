#pragma once

#include <cstddef>
#include <string>

#include "wheatstone/multiview/slice_stack.h"
#include "wheatstone/share/page.h"

namespace wheatstone {

struct ShareSlicesOptions {
  std::string title;
  std::size_t most_bytes = 8'000'000;  ///< of the page
};

/// Slices for a page, which moves and adds them for any view, as `render_slices` does. Light is rounded to 255 steps of
/// a logarithm; where the page would be larger than is wanted, to 127 or 63 of them, and then in pictures of half the
/// width and height, and so on. Throws Error{bad_input} where there are no slices.
SharedPicture share_slices(SliceStack stack, const ShareSlicesOptions& options);

}  // namespace wheatstone
