#include "wheatstone/drawing/relief_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/drawing/relief.h"

namespace wheatstone {
namespace {

/// Where a pixel lies on a stroke: how far along it, in the central view, and across it, as DistanceBand keeps these;
/// and its distance.
struct OnStroke {
  float distance = std::numeric_limits<float>::infinity();
  float along = 0;
  float across = 0;
};

/// A hash of a lattice point, 0..1: the same number as of class Bristles.
float lattice(std::uint32_t seed, std::uint32_t which, float cell) {
  std::uint32_t h = static_cast<std::uint32_t>(static_cast<std::int32_t>(cell)) * 0x9e3779b9u;
  h += seed + which * 0x85ebca6bu;
  h = (h ^ h >> 16) * 0x7feb352du;
  h = (h ^ h >> 15) * 0x846ca68bu;
  return static_cast<float>((h ^ h >> 16) >> 8) * 0x1p-24f;
}

float noise(std::uint32_t seed, std::uint32_t which, float place) {
  const float cell = std::floor(place), part = place - cell;
  const float first = lattice(seed, which, cell);
  return first + part * part * (3 - 2 * part) * (lattice(seed, which, cell + 1) - first);
}

/// The height of the paint there, 0..1, lower at the rim: it stands up where the streaks of class Bristles are lighter.
float bristle_height(const FlatStroke& stroke, float bristle_px, const OnStroke& place) {
  const float lane = place.across / streak_width_px(bristle_px, stroke.radius_px);
  const float fine = noise(stroke.seed, 3, lane);
  const float broad = noise(stroke.seed, 4, lane / 2.3f + place.along / (3 * stroke.radius_px));
  const float to_rim = std::clamp(place.distance / stroke.radius_px, 0.f, 1.f);
  return (0.57f * fine + 0.43f * broad) * (1 - 0.35f * to_rim * to_rim);
}

/// The relief of a band of rows, and the places of its pixels on the stroke at hand.
class ReliefBand {
 public:
  ReliefBand(int top, float bristle_px, const Hiding& hiding, Image<float>& relief)
      : top_(top),
        bristle_px_(bristle_px),
        hiding_(hiding),
        bottom_(std::min(top + band_rows, relief.height())),
        relief_(relief),
        places_(static_cast<std::size_t>(relief.width()) * static_cast<std::size_t>(band_rows)) {}

  void add(const SeenLayer& layer, const FlatStroke& stroke) {
    const BrushProfile brush(stroke.radius_px);
    Columns touched{relief_.width(), 0};
    const std::uint32_t segments = std::max(stroke.vertex_count, 2u) - 1;
    for (std::uint32_t s = 0; s < segments; ++s) {
      const std::size_t from = stroke.first_vertex + s,
                        to = std::min(s + 1, stroke.vertex_count - 1) + stroke.first_vertex;
      const auto point = [&](std::size_t vertex) {
        return Point{layer.x(vertex), layer.flat.y[vertex], layer.flat.disparity[vertex], layer.flat.along[vertex]};
      };
      measure({point(from), point(to), stroke.reference_view}, brush.reach_px, touched);
    }
    const int first = std::max(static_cast<int>(std::floor(stroke.top - brush.reach_px)), top_);
    const int end = std::min(static_cast<int>(std::ceil(stroke.bottom + brush.reach_px)) + 1, bottom_);
    for (int y = first; y < end; ++y) {
      for (int x = touched.left; x < touched.right; ++x) {
        OnStroke& place = at(x, y);
        const float cover = stroke.opacity * brush.cover(place.distance);
        if (cover > 0) lay(stroke, cover, place, relief_(x, y));
        place = {};
      }
    }
  }

 private:
  struct Point {
    float x, y, disparity, along;
  };
  /// A segment of a stroke's spine.
  struct Segment {
    Point a, b;
    ViewPosition planned_in;
  };
  struct Columns {
    int left, right;
  };

  OnStroke& at(int x, int y) {
    return places_[static_cast<std::size_t>(y - top_) * static_cast<std::size_t>(relief_.width()) +
                   static_cast<std::size_t>(x)];
  }

  /// New paint levels what is below it, but not wholly, and stands a little above it.
  void lay(const FlatStroke& stroke, float cover, const OnStroke& place, float& height) const {
    constexpr float shows_through = 0.25f;
    const float own = bristle_height(stroke, bristle_px_, place);
    height += cover * (own + shows_through * height - height);
  }

  /// Notes the pixels to which this is the nearest segment so far, and widens `touched` to their columns.
  void measure(const Segment& segment, float reach, Columns& touched) {
    const auto [a, b, planned_in] = segment;
    const float dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
    const int first_x = std::max(static_cast<int>(std::floor(std::min(a.x, b.x) - reach)), 0);
    const int end_x = std::min(static_cast<int>(std::ceil(std::max(a.x, b.x) + reach)) + 1, relief_.width());
    const int first_y = std::max(static_cast<int>(std::floor(std::min(a.y, b.y) - reach)), top_);
    const int end_y = std::min(static_cast<int>(std::ceil(std::max(a.y, b.y) + reach)) + 1, bottom_);
    if (first_x >= end_x || first_y >= end_y) return;
    touched.left = std::min(touched.left, first_x);
    touched.right = std::max(touched.right, end_x);
    for (int y = first_y; y < end_y; ++y) {
      for (int x = first_x; x < end_x; ++x) {
        const float px = static_cast<float>(x) + 0.5f - a.x, py = static_cast<float>(y) + 0.5f - a.y;
        const float t = length > 0 ? std::clamp((px * dx + py * dy) / (length * length), 0.f, 1.f) : 0;
        const float distance = std::hypot(px - t * dx, py - t * dy);
        OnStroke& place = at(x, y);
        if (distance >= place.distance) continue;
        const float disparity = a.disparity + t * (b.disparity - a.disparity);
        if (is_hidden(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, disparity, planned_in, hiding_))
          continue;
        const float across = length > 0 ? (dx * py - dy * px) / length : py;
        place = {distance, a.along + t * (b.along - a.along), across};
      }
    }
  }

  int top_;
  float bristle_px_;
  const Hiding& hiding_;
  int bottom_;
  Image<float>& relief_;
  std::vector<OnStroke> places_;
};

}  // namespace

Image<float> relief_of(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding, float bristle_px) {
  std::vector<SeenLayer> layers;
  for (const BandedLayer& layer : painting.layers) layers.emplace_back(layer.flat, view);
  Image<float> relief(painting.width, painting.height);
  tbb::parallel_for(0, (painting.height + band_rows - 1) / band_rows, [&](int i) {
    ReliefBand band(i * band_rows, bristle_px, hiding, relief);
    for (std::size_t l = 0; l < layers.size(); ++l) {
      for (const std::uint32_t place : painting.layers[l].bands[static_cast<std::size_t>(i)]) {
        const FlatStroke& stroke = layers[l].flat.strokes[place];
        if (stroke.views.contains(view)) band.add(layers[l], stroke);
      }
    }
  });
  return relief;
}

namespace {

template <class Pixel>
void light_by_lamp(const Image<float>& relief, float depth_px, Image<Pixel>& picture) {
  using Level = decltype(Pixel::r);
  constexpr auto white = static_cast<float>(std::numeric_limits<Level>::max());
  // From the upper left, not steep, so that ridges show; a flat place is lit to exactly its own colour.
  constexpr float lamp_x = -0.45f, lamp_y = -0.55f, lamp_z = 0.70f;
  constexpr float darkest = 0.55f, brightest = 1.5f, gloss = 40 * white / 255;
  tbb::parallel_for(0, picture.height(), [&](int y) {
    const auto above = relief.row(std::max(y - 1, 0)), here = relief.row(y);
    const auto below = relief.row(std::min(y + 1, picture.height() - 1));
    for (int x = 0; x < picture.width(); ++x) {
      const int before = std::max(x - 1, 0), after = std::min(x + 1, picture.width() - 1);
      const float slope_x = depth_px * (here[after] - here[before]) / 2;
      const float slope_y = depth_px * (below[x] - above[x]) / 2;
      const float to_lamp =
          (lamp_z - slope_x * lamp_x - slope_y * lamp_y) / std::sqrt(1 + slope_x * slope_x + slope_y * slope_y);
      const float light = std::clamp(to_lamp / lamp_z, darkest, brightest);
      const float shine = gloss * std::max(light - 1.12f, 0.f);
      const auto lit = [&](Level level) {
        return static_cast<Level>(std::min(light * static_cast<float>(level) + shine, white) + 0.5f);
      };
      Pixel& pixel = picture(x, y);
      if (light != 1) pixel = {lit(pixel.r), lit(pixel.g), lit(pixel.b)};
    }
  });
}

}  // namespace

void light_relief(const Image<float>& relief, float depth_px, Image<Rgb8>& picture) {
  light_by_lamp(relief, depth_px, picture);
}

void light_relief(const Image<float>& relief, float depth_px, Image<Rgb16>& picture) {
  light_by_lamp(relief, depth_px, picture);
}

void light_paint(const PreparedStrokes& painting, ViewPosition view, const Hiding& hiding, const Relief& relief,
                 DrawnView& drawn) {
  if (relief.depth_px <= 0) return;
  const Image<float> heights = relief_of(painting, view, hiding, relief.bristle_px);
  light_relief(heights, relief.depth_px, drawn.picture);
  light_relief(heights, relief.depth_px, drawn.deep);
}

Relief relief_for(const Style& style, int width) {
  constexpr float ridges_px = 1.1f;  // for a picture 640 pixels wide
  Relief relief;
  if (!style.texture) return relief;
  relief.depth_px = ridges_px * style_scale(style, width);
  if (const Brush brush = brush_for(style, width); brush.bristle_px > 0) relief.bristle_px = brush.bristle_px;
  return relief;
}

}  // namespace wheatstone
