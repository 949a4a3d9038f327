#include "wheatstone/app/render_limits.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>
#include <string_view>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// NaN: found.
void check_unless_found(std::string_view name, float value, NumberRange range) {
  if (!std::isnan(value)) check_number(name, value, range);
}

void check_point(std::string_view name, const std::optional<std::array<double, 3>>& point) {
  if (!point) return;
  for (const double coordinate : *point) check_number(name, coordinate, position_range);
}

void check_appearance(const Appearance& appearance) {
  check_number("opacity", appearance.opacity, opacity_range);
  check_number("least opacity", appearance.least_opacity, least_opacity_range);
  check_number("density slope", appearance.density_slope, density_slope_range);
  check_number("density shift", appearance.density_shift, density_shift_range);
  check_number("shine", appearance.shine, shine_range);
  check_unless_found("coldest", appearance.coldest, coordinate_range);
  check_unless_found("hottest", appearance.hottest, coordinate_range);
}

void check_depth(const PerceivedDepth& depth) {
  check_number("near", depth.near_mm, near_range_mm);
  check_number("far", depth.far_mm, far_range_mm);
  check_number("eye", depth.viewing.eye_separation_mm, eye_range_mm);
  check_number("distance", depth.viewing.viewing_distance_mm, distance_range_mm);
  check_number("screen width", depth.viewing.screen_width_mm, screen_width_range_mm);
}

/// Limits the wrong way round.
void check_brightness(const RenderParticlesOptions& options) {
  check_unless_found("least", options.least, coordinate_range);
  check_unless_found("most", options.most, coordinate_range);
  check_unless_found("exposure", options.rendering.exposure, exposure_range);
  if (options.least >= options.most)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("least: is {}, expected below the most, {}", options.least, options.most));
  if (options.rendering.tone.stretch == Stretch::log && options.least <= 0)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("least: is {}, expected above 0 where brightness is logarithmic", options.least));
}

}  // namespace

void check_render_options(const RenderParticlesOptions& options) {
  if (options.positions.empty()) {
    check_number("views", options.views, view_count_range);
    check_number("span", options.span, view_span_range);
  }
  const std::size_t views =
      options.positions.empty() ? static_cast<std::size_t>(options.views) : options.positions.size();
  Rig rig{.width = options.width, .height = options.height, .positions = {}};
  rig.positions.resize(options.without_views ? 1 : views, central_view);
  check_views_fit(rig);
  check_framing(options.framing);
  check_point("look-at", options.look_at);
  check_point("centre", options.selection.centre);
  check_number("subsample", options.selection.every, every_range);
  check_number("neighbours", options.neighbours, neighbours_range);
  check_number("chunk", options.chunk, chunk_range);
  check_number("planes", options.rendering.planes, planes_range);
  check_appearance(options.appearance);
  check_depth(options.depth);
  check_brightness(options);
}

}  // namespace wheatstone
