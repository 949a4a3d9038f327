#include "wheatstone/strokes/wide_painting.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/error.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/warp.h"
#include "wheatstone/strokes/layer_order.h"
#include "wheatstone/strokes/layer_planner.h"
#include "wheatstone/strokes/occluded_part.h"

namespace wheatstone {
namespace {

/// A surface hides a point that is farther by more than this.
constexpr float tolerance_px = 1;

/// The nearest surface in a view; NaN where neither eye shows what is there.
Image<float> surface_in(const Image<float>& left, const Image<float>& right, ViewPosition view) {
  Image<float> surface(left.width(), left.height(), std::numeric_limits<float>::quiet_NaN());
  warp_disparity_over(left, left_eye, view, surface);
  warp_disparity_over(right, right_eye, view, surface);
  return surface;
}

Image<std::uint8_t> unknown_of(const Image<float>& surface) {
  Image<std::uint8_t> mask(surface.width(), surface.height());
  std::ranges::transform(surface.pixels(), mask.pixels().begin(),
                         [](float d) { return static_cast<std::uint8_t>(std::isnan(d) ? 255 : 0); });
  return mask;
}

/// Mirrors the colours of the farther side into every unknown part of a scan line.
void mirror_row(std::span<const std::uint8_t> unknown, std::span<const float> surface, std::span<Rgb8> row) {
  const int width = static_cast<int>(row.size());
  for (int begin = 0; begin < width; ++begin) {
    if (unknown[begin] == 0) continue;
    int end = begin;
    while (end < width && unknown[end] != 0) ++end;
    const bool from_left = end == width || (begin > 0 && surface[begin - 1] <= surface[end]);
    if (begin > 0 || end < width) {
      const int edge = from_left ? begin - 1 : end;
      const int away = from_left ? -1 : 1;
      for (int x = begin; x < end; ++x) {
        int source = edge + away * (std::abs(x - edge) - 1);
        const bool there = source >= 0 && source < width && unknown[source] == 0 &&
                           std::abs(surface[source] - surface[edge]) <= 2 * tolerance_px;
        if (!there) source = edge;
        row[x] = row[source];
      }
    }
    begin = end;
  }
}

/// What an outermost view would see, as far as the photographs tell, and which part of it they do not tell.
struct OuterView {
  Image<Rgb8> picture;
  Image<float> disparity;
  Image<std::uint8_t> unknown;
};

OuterView outer_view(const StereoPair& photographs, const StereoGeometry& geometry, ViewPosition view) {
  OuterView outer;
  outer.disparity = surface_in(geometry.left_disparity, geometry.right_disparity, view);
  outer.unknown = unknown_of(outer.disparity);
  const auto from_left = [&] { return warp_picture(photographs.left, geometry.left_disparity, left_eye, view); };
  const auto from_right = [&] { return warp_picture(photographs.right, geometry.right_disparity, right_eye, view); };
  WarpedPicture nearer = view < central_view ? from_left() : from_right();
  outer.picture = view < central_view ? from_right().picture : from_left().picture;
  lay_over(nearer, outer.picture);
  tbb::parallel_for(0, outer.picture.height(),
                    [&](int y) { mirror_row(outer.unknown.row(y), outer.disparity.row(y), outer.picture.row(y)); });
  fill_from_farther_side(outer.disparity);
  return outer;
}

/// Whether a surface of the view hides a point of a stroke.
bool is_hidden(const ControlPoint& point, ViewPosition reference_view, ViewPosition view, const Image<float>& surface) {
  const int x = static_cast<int>(std::floor(x_in_view(point, reference_view, view)));
  const int y = static_cast<int>(point.y);
  return surface.contains(x, y) && surface(x, y) > point.disparity + tolerance_px;
}

/// The parts of a layer's strokes that a view sees.
Layer seen_part(const Layer& layer, ViewPosition view, const Image<float>& surface) {
  Layer seen{layer.radius_px, layer.points, {}};
  seen.strokes.reserve(layer.strokes.size());
  for (const Stroke& stroke : layer.strokes) {
    if (!stroke.views.contains(view)) continue;
    const auto hidden = [&](std::uint32_t i) {
      return is_hidden(layer.points[stroke.first_point + i], stroke.reference_view, view, surface);
    };
    for (std::uint32_t begin = 0; begin < stroke.point_count; ++begin) {
      if (hidden(begin)) continue;
      std::uint32_t end = begin + 1;
      while (end < stroke.point_count && !hidden(end)) ++end;
      Stroke part = stroke;
      part.first_point = stroke.first_point + begin;
      part.point_count = end - begin;
      seen.strokes.push_back(part);
      begin = end;
    }
  }
  return seen;
}

/// Gives bare pixels the colour of the nearest painted pixels on their scan line, from the side that is farther away.
void cover_bare(const Image<std::uint8_t>& bare, const Image<float>& surface, Image<Rgb8>& picture) {
  const int width = picture.width();
  tbb::parallel_for(0, picture.height(), [&](int y) {
    const auto mask = bare.row(y);
    const auto row = picture.row(y);
    for (int begin = 0; begin < width; ++begin) {
      if (mask[begin] == 0) continue;
      int end = begin;
      while (end < width && mask[end] != 0) ++end;
      const bool from_left = end == width || (begin > 0 && !(surface(begin - 1, y) > surface(end, y)));
      if (begin > 0 || end < width) std::fill(row.begin() + begin, row.begin() + end, row[from_left ? begin - 1 : end]);
      begin = end;
    }
  });
}

/// What the photographs show of a view, their colours drawn out over what they do not.
Image<Rgb8> photographed(const WidePainting& wide, const Image<float>& surface, ViewPosition view) {
  Composition composition{view, Image<Rgb8>(surface.width(), surface.height()),
                          Image<float>(surface.width(), surface.height(), std::numeric_limits<float>::quiet_NaN())};
  const auto lay_left = [&] {
    warp_picture_over(wide.behind.left, wide.left_disparity, left_eye, tolerance_px, composition);
  };
  if (view < central_view) lay_left();
  warp_picture_over(wide.behind.right, wide.right_disparity, right_eye, tolerance_px, composition);
  if (view >= central_view) lay_left();
  cover_bare(unknown_of(composition.nearest), composition.nearest, composition.picture);
  return std::move(composition.picture);
}

/// A stroke has one disparity, the surface that it lies on may slope: within a brush's tolerance the surface's is
/// taken.
void follow_surface(const Image<float>& surface, Image<float>& disparity) {
  constexpr float slope_px = 3;
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto from = surface.row(y);
    const auto to = disparity.row(y);
    for (std::size_t x = 0; x < to.size(); ++x)
      if (std::abs(from[x] - to[x]) <= slope_px) to[x] = from[x];
  });
}

/// A view that strokes are drawn for, from which those near it are made.
struct KeyView {
  ViewPosition view;
  DrawnView drawn;
};

/// The view at a position from the keys on both its sides, the nearer one first.
DrawnView between(std::span<const KeyView> keys, ViewPosition view) {
  const auto right = std::ranges::find_if(keys, [view](const KeyView& key) { return key.view >= view; });
  std::vector<const KeyView*> around;
  if (right != keys.end()) around.push_back(&*right);
  if (right != keys.begin()) around.push_back(&*(right - 1));
  std::ranges::sort(around, {}, [view](const KeyView* key) { return std::abs(key->view - view); });
  const Image<Rgb8>& nearest = around.front()->drawn.picture;
  if (around.front()->view == view) return {nearest, around.front()->drawn.bare_share, {}, {}};

  Composition composition{view, Image<Rgb8>(nearest.width(), nearest.height()),
                          Image<float>(nearest.width(), nearest.height(), std::numeric_limits<float>::quiet_NaN())};
  for (const KeyView* key : around)
    warp_picture_over(key->drawn.picture, key->drawn.disparity, key->view, tolerance_px, composition);
  const Image<std::uint8_t> bare = unknown_of(composition.nearest);
  const auto count = std::ranges::count(bare.pixels(), 255);
  cover_bare(bare, composition.nearest, composition.picture);
  return {
      std::move(composition.picture), static_cast<double>(count) / static_cast<double>(bare.pixels().size()), {}, {}};
}

}  // namespace

WidePainting widen(StrokePainting painting, const StereoPair& photographs, const StereoGeometry& geometry,
                   const Style& style, ViewRange views) {
  if (style.propagation != Propagation::strokes)
    throw Error(ErrorKind::wrong_usage,
                "views beside the two eyes need strokes that are propagated, expected propagation 'strokes'");
  for (Layer& layer : painting.layers)
    for (Stroke& stroke : layer.strokes) stroke.views = views;
  std::vector<StrokePainting> outer;
  for (const ViewPosition view : {views.first, views.last}) {
    if (view >= left_eye && view <= right_eye) continue;
    const OuterView seen = outer_view(photographs, geometry, view);
    outer.push_back(plan_occluded_part(seen.picture, seen.disparity, seen.unknown, view, style));
  }
  for (std::size_t i = 0; i < painting.layers.size(); ++i) {
    for (StrokePainting& part : outer) {
      for (Stroke& stroke : part.layers[i].strokes) stroke.views = views;
      append_strokes(part.layers[i], painting.layers[i]);
    }
    order_strokes(painting.layers[i], style, static_cast<int>(i));
  }
  WidePainting wide{std::move(painting), views, geometry.left_disparity, geometry.right_disparity, {}};
  if (style.background == Background::photograph) wide.behind = photographs;
  return wide;
}

DrawnView draw(const WidePainting& wide, ViewPosition view, bool with_disparity) {
  const Image<float> surface = surface_in(wide.left_disparity, wide.right_disparity, view);
  StrokePainting seen{wide.painting.width, wide.painting.height, wide.painting.canvas_colour,
                      std::vector<Layer>(wide.painting.layers.size())};
  tbb::parallel_for(std::size_t{0}, seen.layers.size(),
                    [&](std::size_t i) { seen.layers[i] = seen_part(wide.painting.layers[i], view, surface); });
  const Image<Rgb8> behind = wide.behind.left.empty() ? Image<Rgb8>() : photographed(wide, surface, view);
  DrawnView drawn = draw(seen, view, {.background = behind, .with_disparity = with_disparity});
  cover_bare(drawn.bare, surface, drawn.picture);
  if (with_disparity) follow_surface(surface, drawn.disparity);
  return drawn;
}

std::vector<DrawnView> draw_views(const WidePainting& wide, std::span<const ViewPosition> positions) {
  std::vector<KeyView> keys;
  for (const ViewPosition view : {wide.views.first, left_eye, right_eye, wide.views.last})
    if (keys.empty() || view > keys.back().view) keys.push_back({view, {}});
  tbb::parallel_for(std::size_t{0}, keys.size(),
                    [&](std::size_t i) { keys[i].drawn = draw(wide, keys[i].view, true); });
  std::vector<DrawnView> drawn(positions.size());
  tbb::parallel_for(std::size_t{0}, positions.size(), [&](std::size_t i) { drawn[i] = between(keys, positions[i]); });
  return drawn;
}

}  // namespace wheatstone
