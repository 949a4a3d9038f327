#include "wheatstone/painting/mend_drawn_internal.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>
#include <variant>
#include <vector>

#include "wheatstone/marks/residual.h"
#include "wheatstone/painting/over_spots_internal.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/strokes/accents.h"
#include "wheatstone/strokes/layer_order.h"

namespace wheatstone {
namespace {

/// The strokes that mend a picture: dots, since the curve of longer ones passes beside their points.
Layer strokes_for(const SpotsOfView& spots, Style style) {
  style.max_length = 1;
  StrokePainting painting{.width = spots.photograph.width(), .height = spots.photograph.height(), .layers = {Layer{}}};
  add_accents(spots, style, painting);
  return std::move(painting.layers.front());
}

struct Rows {
  int first, end;
};

/// The rows that strokes may touch.
Rows rows_of(const Layer& strokes, int height) {
  const auto [top, bottom] = std::ranges::minmax(strokes.points, {}, &ControlPoint::y);
  const float reach = std::ranges::max(strokes.strokes, {}, &Stroke::radius_px).radius_px + 2;
  return {std::max(static_cast<int>(top.y - reach), 0), std::min(static_cast<int>(bottom.y + reach) + 1, height)};
}

ImageView<const Rgb8> part_of(ImageView<const Rgb8> picture, Rows rows) {
  return {picture.row(rows.first).data(), picture.width(), rows.end - rows.first, picture.stride()};
}

/// Draws strokes over rows of a picture. No surface hides them: they lie before all that is about them.
void draw_over(Layer strokes, Rows rows, const SceneView& view, DrawnView& drawn) {
  for (ControlPoint& point : strokes.points) point.y -= static_cast<float>(rows.first);
  Painting painting;
  painting.marks =
      StrokePainting{.width = drawn.picture.width(), .height = rows.end - rows.first, .layers = {std::move(strokes)}};
  const DrawnView mended = draw(prepare(painting), view.position, part_of(drawn.picture, rows));
  std::int64_t covered = 0;
  for (int y = rows.first; y < rows.end; ++y) {
    std::ranges::copy(mended.picture.row(y - rows.first), drawn.picture.row(y).begin());
    const auto still_bare = mended.bare.row(y - rows.first);
    const auto bare = drawn.bare.row(y);
    for (std::size_t x = 0; x < bare.size(); ++x) {
      covered += bare[x] != 0 && still_bare[x] == 0 ? 1 : 0;
      bare[x] &= still_bare[x];
    }
  }
  drawn.bare_share -= static_cast<double>(covered) / static_cast<double>(drawn.bare.pixels().size());
}

/// The wrong pixels of some rows.
Image<std::uint8_t> wrong_in(Rows rows, const Image<Rgb8>& painted, ImageView<const Rgb8> photograph) {
  const int width = painted.width(), near_px = static_cast<int>(std::ceil(nearness_px(width)));
  const Rows judged{std::max(rows.first - near_px, 0), std::min(rows.end + near_px, painted.height())};
  const Image<std::uint8_t> in_judged = residual(part_of(painted, judged), part_of(photograph, judged));
  Image<std::uint8_t> wrong(width, painted.height());
  for (int y = rows.first; y < rows.end; ++y) std::ranges::copy(in_judged.row(y - judged.first), wrong.row(y).begin());
  return wrong;
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
  constexpr int most_rounds = 3;  // dots may reach over their neighbours
  const ViewPosition reference = views.front().position;
  std::vector<Layer>& layers = std::get<StrokePainting>(painting.marks).layers;
  for (std::size_t i = 0; i < shown.size(); ++i) {
    const SceneView& view = views[shown[i]];
    Image<std::uint8_t> places = residual(pictures[i].picture, view.picture);
    for (int round = 0; round < most_rounds; ++round) {
      remove_occlusion_specks(places, least_repaired_px);
      if (std::memchr(places.pixels().data(), 255, places.pixels().size()) == nullptr) break;
      const Image<float> disparity = disparity_before(view.disparity, places);
      const ViewRange seen_from = shown[i] == 0 ? all_views : views_about(view.position, reference);
      Layer strokes = strokes_for(
          {view.picture, places, disparity, view.position, reference, seen_from, painting.surfaces.tolerance_px},
          style);
      if (strokes.strokes.empty()) break;
      append_strokes(strokes, layers.back());
      const Rows rows = rows_of(strokes, view.picture.height());
      draw_over(std::move(strokes), rows, view, pictures[i]);
      places = wrong_in(rows, pictures[i].picture, view.picture);
    }
  }
}

}  // namespace wheatstone
