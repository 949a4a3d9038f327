#include "pointing.h"

#include <cmath>
#include <limits>
#include <vector>

#include "particle_moves.h"
#include "particle_scene.h"
#include "wheatstone/depth/warp_row.h"

namespace wheatstone::viewer {
namespace {

constexpr float unknown_disparity = std::numeric_limits<float>::quiet_NaN();

/// The nearest surfaces of one row, as a view sees them: those of photographs first.
std::vector<float> seen_row(const Surfaces& surfaces, ViewPosition view, int y, int width) {
  std::vector<float> nearest(width, unknown_disparity);
  std::vector<float> continued(width, unknown_disparity);
  for (const Surface& surface : surfaces.seen)
    if (y < surface.disparity.height())
      warp_disparity_row_over(surface.disparity.row(y), view - surface.view, surface.left_px,
                              surface.continued ? continued : nearest);
  close_cracks(nearest);
  for (int x = 0; x < width; ++x)
    if (std::isnan(nearest[x])) nearest[x] = continued[x];
  return nearest;
}

std::vector<float> seen_row(const StereoGeometry& geometry, ViewPosition view, int y) {
  std::vector<float> nearest(geometry.left_disparity.width(), unknown_disparity);
  warp_disparity_row_over(geometry.left_disparity.row(y), view - left_eye, 0, nearest);
  warp_disparity_row_over(geometry.right_disparity.row(y), view - right_eye, 0, nearest);
  return nearest;
}

}  // namespace

std::optional<float> disparity_at(const Content& content, const PlaceInView& place) {
  const PictureSize size = size_of(content);
  const int x = static_cast<int>(std::floor(place.x)), y = static_cast<int>(std::floor(place.y));
  const auto* const painted = std::get_if<PaintedContent>(&content);
  if (painted == nullptr || x < 0 || y < 0 || x >= size.width || y >= size.height) return {};
  float disparity = unknown_disparity;
  if (painted->painting && !painted->painting->surfaces.seen.empty())
    disparity = seen_row(painted->painting->surfaces, place.view, y, size.width)[x];
  else if (painted->photograph && painted->photograph->geometry)
    disparity = seen_row(*painted->photograph->geometry, place.view, y)[x];
  if (std::isnan(disparity)) return {};
  return disparity;
}

std::optional<SeenPlace> seen_at(const Viewer& viewer, double x, double y) {
  const std::optional<float> disparity = disparity_under(viewer, x, y);
  if (!disparity) return {};
  const Frame& frame = *viewer.frame();
  PlaceInView place = *place_at(frame.places, x, y);
  const auto* const painted = std::get_if<PaintedContent>(&frame.shown);
  if (painted == nullptr || !painted->painting || painted->painting->surfaces.seen.empty())
    return SeenPlace{static_cast<float>(place.x), static_cast<float>(place.y), *disparity};
  const ViewPosition reference = painted->painting->surfaces.seen.front().view;
  place.x += (place.view - reference) * *disparity;
  place.view = reference;
  return SeenPlace{static_cast<float>(place.x), static_cast<float>(place.y),
                   disparity_at(frame.placed, place).value_or(*disparity)};
}

std::optional<float> disparity_under(const Viewer& viewer, double x, double y) {
  const Frame* const frame = viewer.frame();
  const std::optional<PlaceInView> place = frame != nullptr ? place_at(frame->places, x, y) : std::nullopt;
  if (!place) return {};
  const Session& session = viewer.session();
  const Particles* const particles = open_particles(viewer);
  if (particles == nullptr) return disparity_at(frame->shown, *place);
  const Scene scene = particle_scene(*particles, session.state, eyes_of(viewer));
  const std::optional<SeenParticle> seen = particle_at(*particles, scene, *place);
  return seen ? std::optional(-seen->parallax_px) : std::nullopt;
}

}  // namespace wheatstone::viewer
