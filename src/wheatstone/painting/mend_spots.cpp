#include "wheatstone/painting/mend_spots_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "wheatstone/curves/accents.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/marks/residual.h"
#include "wheatstone/painting/over_spots_internal.h"
#include "wheatstone/regions/accents.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/strokes/accents.h"

namespace wheatstone {
namespace {

/// What a view would show if it saw the reference view's colours where its disparities say so.
Image<Rgb8> colours_of_reference(const SceneView& view, const SceneView& reference) {
  Image<Rgb8> colours(view.picture.width(), view.picture.height());
  const float separation = view.position - reference.position;
  tbb::parallel_for(0, colours.height(), [&](int y) {
    const auto from = reference.picture.row(y), own = view.picture.row(y);
    const auto to = colours.row(y);
    for (int x = 0; x < colours.width(); ++x) {
      const float place = static_cast<float>(x) + 0.5f + separation * view.disparity(x, y);
      const bool is_shared = (view.only_here.empty() || view.only_here(x, y) == 0) && place >= 0 &&
                             place < static_cast<float>(colours.width());
      to[x] = is_shared ? from[static_cast<std::size_t>(place)] : own[x];
    }
  });
  return colours;
}

/// Where marks of the reference view come to lie on what another view shows something else of: their disparity is
/// wrong.
Image<std::uint8_t> displaced_colours(const SceneView& view, const SceneView& reference) {
  constexpr int rim_px = 2;
  Image<std::uint8_t> spots = residual(colours_of_reference(view, reference), view.picture);
  remove_occlusion_specks(spots, least_repaired_px);
  return dilate_occlusion(spots, rim_px);
}

bool has_any(const Image<std::uint8_t>& mask) {
  return std::ranges::any_of(mask.pixels(), [](std::uint8_t value) { return value != 0; });
}

void add_accents_of(const SpotsOfView& found, const Style& style, Painting& painting) {
  if (auto* const strokes = std::get_if<StrokePainting>(&painting.marks))
    add_accents(found, style, *strokes);
  else
    add_accents(found, std::get<DiffusionPainting>(painting.marks));
}

/// Nearly all that is wrong with strokes is displaced: drawing them would tell little more, and cost more.
void mend_displaced(std::span<const SceneView> views, const Style& style, Painting& painting) {
  if (style.marks == Marks::strokes && style.jitter != ColourJitter{}) return;
  const SceneView& reference = views.front();
  for (const SceneView& view : views.subspan(1)) {
    if (view.continued) continue;
    const Image<std::uint8_t> spots = displaced_colours(view, reference);
    if (!has_any(spots)) continue;
    const Image<float> disparity = disparity_before(view.disparity, spots);
    const ViewRange about = views_about(view.position, reference.position);
    add_accents_of(
        {view.picture, spots, disparity, view.position, reference.position, about, painting.surfaces.tolerance_px},
        style, painting);
  }
}

/// What has no edges of its own, as a soft light, or edges too short to follow, is missing between the lines: that is
/// known only when their colours have spread. The reference view's is mended first, for all views. That suffices for
/// eyes beside a central view, which are half as far from it and are moved towards it where depth is reduced; one eye
/// lacks more of what the other shows.
void mend_lines(std::span<const SceneView> views, Painting& painting) {
  const ViewPosition reference = views.front().position;
  const bool refers_to_eye = reference == left_eye || reference == right_eye;
  for (const SceneView& view : views) {
    const bool is_reference = view.position == reference;
    if (view.continued || !(is_reference || refers_to_eye)) continue;
    Image<std::uint8_t> spots = residual(draw(painting, view.position).picture, view.picture);
    remove_occlusion_specks(spots, least_repaired_px);
    if (!has_any(spots)) continue;
    add_accents({view.picture, spots, view.disparity, view.position, reference,
                 is_reference ? all_views : views_about(view.position, reference), painting.surfaces.tolerance_px},
                std::get<DiffusionPainting>(painting.marks));
  }
}

void mend_regions(std::span<const SceneView> views, const Style& style, Painting& painting) {
  const ViewPosition reference = views.front().position;
  for (const SceneView& view : views) {
    if (view.continued) continue;
    const bool is_reference = view.position == reference;
    const Image<std::uint8_t> spots = residual(draw(painting, view.position).picture, view.picture);
    if (!has_any(spots)) continue;
    const Image<float> before = is_reference ? Image<float>() : disparity_before(view.disparity, spots);
    const SpotsOfView found{view.picture,
                            spots,
                            is_reference ? view.disparity : before.view(),
                            view.position,
                            reference,
                            is_reference ? all_views : views_about(view.position, reference),
                            painting.surfaces.tolerance_px};
    add_accents(found, style, std::get<RegionPainting>(painting.marks));
  }
}

}  // namespace

void mend_spots(std::span<const SceneView> views, const Style& style, Painting& painting) {
  if (style.propagation == Propagation::independent) return;
  if (style.marks == Marks::regions) mend_regions(views, style, painting);
  if (views.front().picture.width() < least_repaired_width_px) return;
  if (style.marks == Marks::strokes || style.marks == Marks::curves) mend_displaced(views, style, painting);
  if (style.marks == Marks::curves) mend_lines(views, painting);
}

}  // namespace wheatstone
