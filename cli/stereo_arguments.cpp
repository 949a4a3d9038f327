#include "stereo_arguments.h"

#include <fmt/format.h>

#include "wheatstone/error.h"
#include "wheatstone/image/read_image.h"

namespace wheatstone::cli {

StereoPair read_pair(const std::string& left, const std::string& right) {
  StereoPair pair{read_image(left), read_image(right)};
  if (!same_size(pair.left, pair.right))
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {}x{} pixels, expected {}x{} as {}", right, pair.right.width(), pair.right.height(),
                            pair.left.width(), pair.left.height(), left));
  constexpr int least_side_px = 16;
  if (pair.left.width() < least_side_px || pair.left.height() < least_side_px)
    throw Error(ErrorKind::bad_input, fmt::format("{}: is {}x{} pixels, expected at least {}x{}", left,
                                                  pair.left.width(), pair.left.height(), least_side_px, least_side_px));
  return pair;
}

}  // namespace wheatstone::cli
