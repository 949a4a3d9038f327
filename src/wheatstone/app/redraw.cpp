#include "wheatstone/app/redraw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "wheatstone/app/write_svg.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/percentile.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

float nearest_disparity(const Painting& painting) {
  std::vector<float> disparities = disparities_of_marks(painting);
  if (disparities.empty()) return 0;
  constexpr double nearest_share = 0.995;
  return percentile(std::move(disparities), nearest_share);
}

}  // namespace

Painting scaled(const Painting& painting, double scale) {
  constexpr double largest_side_px = 65535;
  const double width = std::round(painting.painting.width * scale),
               height = std::round(painting.painting.height * scale);
  if (!(width >= 1 && height >= 1 && width <= largest_side_px && height <= largest_side_px))
    throw Error(ErrorKind::wrong_usage, fmt::format("--scale {} makes {}x{} pixels, expected 1 to {} a side", scale,
                                                    width, height, largest_side_px));
  return resized(painting, scale);
}

void draw_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options) {
  const Painting sized = scaled(painting, options.scale);
  const StereoPair pictures{draw(sized, left_eye).picture, draw(sized, right_eye).picture};
  const StereoPair presented = set_convergence(pictures, nearest_disparity(sized));
  write_image(folder.file("left.png"), pictures.left);
  write_image(folder.file("right.png"), pictures.right);
  write_image(folder.file("side_by_side.png"), side_by_side(presented));
  write_image(folder.file("anaglyph.png"), anaglyph(presented));
  if (options.svg) {
    write_svg(folder.file("left.svg"), sized, left_eye);
    write_svg(folder.file("right.svg"), sized, right_eye);
  }
  folder.commit();
}

}  // namespace wheatstone
