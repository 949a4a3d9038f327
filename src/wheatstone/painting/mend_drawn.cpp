#include "wheatstone/painting/mend_drawn_internal.h"

#include <algorithm>
#include <cstring>
#include <utility>
#include <variant>
#include <vector>

#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/painting/over_spots_internal.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/strokes/accents.h"
#include "wheatstone/strokes/layer_order.h"

namespace wheatstone {
namespace {

/// The strokes that mend a picture.
Layer strokes_for(const SpotsOfView& spots, const Style& style) {
  StrokePainting painting{.width = spots.photograph.width(), .height = spots.photograph.height(), .layers = {Layer{}}};
  add_accents(spots, style, painting);
  return std::move(painting.layers.front());
}

/// Draws strokes over a picture. No surface hides them: they lie before all that is about them.
void draw_over(Layer strokes, const SceneView& view, DrawnView& drawn) {
  Painting painting;
  painting.marks =
      StrokePainting{.width = view.picture.width(), .height = view.picture.height(), .layers = {std::move(strokes)}};
  DrawnView mended = draw(prepare(painting), view.position, drawn.picture);
  std::ranges::transform(drawn.bare.pixels(), mended.bare.pixels(), drawn.bare.pixels().begin(),
                         [](std::uint8_t was, std::uint8_t is) { return static_cast<std::uint8_t>(was & is); });
  drawn.picture = std::move(mended.picture);
  const auto is_bare = [](std::uint8_t value) { return value != 0; };
  const auto pixels = static_cast<double>(drawn.bare.width()) * drawn.bare.height();
  drawn.bare_share = static_cast<double>(std::ranges::count_if(drawn.bare.pixels(), is_bare)) / pixels;
}

}  // namespace

bool is_mended_when_drawn(const Painting& painting, const Style& style) {
  // Where less is near than the finest brush is wide, noise makes spots come and go.
  constexpr double least_near_px = 2;
  const auto* const strokes = std::get_if<StrokePainting>(&painting.marks);
  return strokes != nullptr && !strokes->layers.empty() && nearness_px(strokes->width) >= least_near_px &&
         style.jitter == ColourJitter{} && style.propagation != Propagation::independent &&
         painting.relief.depth_px <= 0;
}

void mend_drawn(std::span<const SceneView> views, std::span<const std::size_t> shown, const Style& style,
                Painting& painting, std::span<DrawnView> pictures) {
  const ViewPosition reference = views.front().position;
  std::vector<Layer>& layers = std::get<StrokePainting>(painting.marks).layers;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const SceneView& view = views[shown[i]];
    Image<std::uint8_t> places = wrong_pixels(pictures[i].picture, view.picture);
    remove_occlusion_specks(places, least_spot_px);
    if (std::memchr(places.pixels().data(), 255, places.pixels().size()) == nullptr) continue;
    const Image<float> disparity = disparity_before(view.disparity, places);
    const ViewRange seen_from = shown[i] == 0 ? all_views : views_about(view.position, reference);
    Layer strokes = strokes_for(
        {view.picture, places, disparity, view.position, reference, seen_from, painting.surfaces.tolerance_px}, style);
    append_strokes(strokes, layers.back());
    draw_over(std::move(strokes), view, pictures[i]);
  }
}

}  // namespace wheatstone
