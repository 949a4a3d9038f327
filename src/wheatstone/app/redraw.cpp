#include "wheatstone/app/redraw.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/app/present_pair.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/app/write_svg.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/percentile.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {

float nearest_disparity(const Painting& painting) {
  std::vector<float> disparities = disparities_of_marks(painting);
  if (disparities.empty()) return 0;
  constexpr double nearest_share = 0.995;
  return percentile(std::move(disparities), nearest_share);
}

Painting scaled(const Painting& painting, double scale) {
  constexpr double largest_side_px = 65535;
  const double width = std::round(width_of(painting) * scale), height = std::round(height_of(painting) * scale);
  if (!(width >= 1 && height >= 1 && width <= largest_side_px && height <= largest_side_px))
    throw Error(ErrorKind::wrong_usage, fmt::format("a scale of {} makes {}x{} pixels, expected 1 to {} a side", scale,
                                                    width, height, largest_side_px));
  return placed(painting, {.scale = scale});
}

void draw_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options,
                const Progress& progress) {
  Painting sized = scaled(painting, options.scale);
  if (options.zero_parallax_px) shared_width(width_of(sized), *options.zero_parallax_px);
  sized = place_depth(std::move(sized), options.depth, width_of(sized));
  const bool is_placed = !options.depth.regions.empty();
  const auto picture = [&](const char* name) { return fmt::format("{}.{}", name, options.format); };
  report(progress, "drawing", 0);
  const PreparedPainting prepared = prepare(sized, {}, options.device);
  const float separation = is_placed ? 1 : comfortable_separation(sized, options.depth_budget);
  std::vector<ViewPosition> views{left_eye, right_eye};
  std::ranges::copy(presented_views(separation), std::back_inserter(views));
  std::vector<DrawnView> drawn = draw(prepared, views);
  const StereoPair pictures{std::move(drawn[0].picture), std::move(drawn[1].picture)};
  std::vector<Image<Rgb8>> nearer;
  for (DrawnView& view : std::span(drawn).subspan(2)) nearer.push_back(std::move(view.picture));
  const float zero_parallax_px = is_placed ? 0 : options.zero_parallax_px.value_or(nearest_disparity(sized));
  const StereoPair presented = present_pair(nearer, pictures, separation, zero_parallax_px);
  report(progress, "writing", 0);
  write_image(folder.file(picture("left")), pictures.left);
  write_image(folder.file(picture("right")), pictures.right);
  write_image(folder.file(picture("side_by_side")), side_by_side(presented));
  write_image(folder.file(picture("anaglyph")), anaglyph(presented));
  if (options.svg) {
    write_svg(folder.file("left.svg"), sized, left_eye);
    write_svg(folder.file("right.svg"), sized, right_eye);
  }
  folder.commit();
}

}  // namespace wheatstone
