#include "wheatstone/app/paint_photograph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/app/detail_map.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/error.h"
#include "wheatstone/image/known_values.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/stereo/fitting_pair.h"
#include "wheatstone/stereo/geometry_from_disparity.h"

namespace wheatstone {
namespace {

StereoGeometry given_geometry(const StereoPair& photographs, const PaintPhotographOptions& options) {
  check_same_size("the left disparity", *options.left_disparity, "the photographs'", photographs.left);
  if (!options.right_disparity) return geometry_from_left(*options.left_disparity);
  check_same_size("the right disparity", *options.right_disparity, "the photographs'", photographs.left);
  return geometry_from_both(*options.left_disparity, *options.right_disparity);
}

/// The map that is to be found where none was given.
Image<std::uint8_t> found_detail(ImageView<const Rgb8> left, const PaintPhotographOptions& options) {
  if (options.detail || !reads_detail(options.style)) return {};
  return detail_of_faces(left);
}

}  // namespace

float screen_disparity(const ZeroParallax& wanted, const StereoGeometry& geometry) {
  if (wanted.disparity_px) return *wanted.disparity_px;
  if (wanted.at) {
    const auto [x, y] = *wanted.at;
    if (!geometry.left_disparity.contains(x, y))
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("the zero-parallax point {},{} lies outside the {}x{} pixels of the picture", x, y,
                              geometry.left_disparity.width(), geometry.left_disparity.height()));
    return geometry.left_disparity(x, y);
  }
  constexpr double nearest_share = 0.995;
  return disparity_percentile(geometry.left_disparity, nearest_share);
}

FoundGeometry find_geometry(const StereoPair& photographs, const PaintPhotographOptions& options,
                            const Progress& progress) {
  if (photographs.right.empty() && !options.left_disparity)
    return {{.left_disparity = Image<float>(photographs.left.width(), photographs.left.height())}, {}, {}};
  check_fits(photographs);
  if (options.left_disparity) return {given_geometry(photographs, options), {}, {}};
  MatchedPair matched = match(photographs, options.matching, progress);
  const MatchConfidence confidence = measure_match(photographs, matched, options.matching.range);
  StereoGeometry geometry = std::exchange(matched.geometry, {});
  return {std::move(geometry), std::move(matched), confidence};
}

PaintedPhotograph paint_photograph(const StereoPair& photographs, const PaintPhotographOptions& options,
                                   const Progress& progress) {
  check_style(options.style);
  if (options.zero_parallax.disparity_px) shared_width(photographs.left.width(), *options.zero_parallax.disparity_px);
  PaintedPhotograph result;
  FoundGeometry found = find_geometry(photographs, options, progress);
  result.geometry = std::move(found.geometry);
  result.matched = std::move(found.matched);
  result.confidence = found.confidence;
  result.zero_parallax_px = screen_disparity(options.zero_parallax, result.geometry);
  shared_width(photographs.left.width(), result.zero_parallax_px);
  const Image<std::uint8_t> found_map = found_detail(photographs.left, options);
  result.painted = paint(photographs, result.geometry, options.style, progress, {options.depth_budget, options.device},
                         options.detail ? *options.detail : found_map, options.known);
  return result;
}

void redraw_with_depth(const DepthPlacing& placing, PaintedPhotograph& result) {
  if (placing.regions.empty()) return;
  PaintedPair& painted = result.painted;
  const int width_px = width_of(painted.painting);
  painted.painting = place_depth(std::move(painted.painting), placing, width_px);
  Presented shown = present(painted.painting, for_two_eyes());
  painted.pictures = {std::move(shown.views.front()), std::move(shown.views.back())};
  result.zero_parallax_px = 0;
}

PaintedViews paint_views(const StereoPair& photographs, const PaintPhotographOptions& painting,
                         DisplayViewsOptions views, const Progress& progress,
                         const std::optional<DisplayComposition>& composition) {
  check_style(painting.style);
  if (painting.style.propagation != Propagation::strokes)
    throw Error(ErrorKind::wrong_usage,
                "views beside the two eyes need strokes that are propagated, expected propagation 'strokes'");
  const FoundGeometry found = find_geometry(photographs, painting, progress);
  if (painting.zero_parallax.disparity_px || painting.zero_parallax.at)
    views.zero_parallax_px = screen_disparity(painting.zero_parallax, found.geometry);
  const Image<std::uint8_t> found_map = found_detail(photographs.left, painting);
  const Painting planned = plan_painting(photographs, found.geometry, painting.style, progress, widest_views,
                                         painting.detail ? *painting.detail : found_map, painting.known);
  return {draw_display_views(planned, views, progress, composition), found.confidence};
}

PairMeasures measure_pair(const StereoPair& pair, ImageView<const float> left_disparity) {
  check_known_anywhere(left_disparity, "the disparity");
  return {measure_left_right_difference(pair, left_disparity), measure_depth_survival(pair, left_disparity),
          gradient_energy(pair.left), gradient_energy(pair.right)};
}

}  // namespace wheatstone
