#include "wheatstone/drawing/rasterise.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <cmath>

#include "largest_difference.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/drawing/rasterise_internal.h"
#include "wheatstone/random.h"

namespace wheatstone::rasterise_test {

/// Strokes of all sizes and opacities, also over the picture's edges.
Layer random_layer(int width, int height, int count, float opacity) {
  Layer layer;
  layer.radius_px = 4;
  const auto random = [](std::uint64_t i, std::uint64_t j) { return unit_float(hash_keys({i, j})); };
  for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
    Stroke stroke;
    stroke.first_point = static_cast<std::uint32_t>(layer.points.size());
    stroke.point_count = 1 + static_cast<std::uint32_t>(random(i, 0) * 6);
    stroke.radius_px = 0.7f + 12 * random(i, 1) * random(i, 1);
    stroke.opacity = opacity;
    stroke.colour = {static_cast<std::uint8_t>(255 * random(i, 2)), static_cast<std::uint8_t>(255 * random(i, 3)), 90};
    float x = (random(i, 4) * 1.2f - 0.1f) * static_cast<float>(width);
    float y = (random(i, 5) * 1.2f - 0.1f) * static_cast<float>(height);
    for (std::uint32_t p = 0; p < stroke.point_count; ++p) {
      layer.points.push_back({x, y, 10 * random(i, 6)});
      x += stroke.radius_px * (2 * random(i, 10 + p) - 1);
      y += stroke.radius_px * (2 * random(i, 20 + p) - 1);
    }
    layer.strokes.push_back(stroke);
  }
  return layer;
}

/// Where a pixel lies on a stroke, and how its side faces the light.
struct OnStroke {
  float distance = INFINITY, along = 0, across = 0, facing = 0;
};

/// Number by number what bristles_simd_internal.h does with vectors.
class PlainBristles {
 public:
  PlainBristles(const FlatStroke& stroke, const Brush& brush)
      : stroke_(stroke), brush_(brush), width_(std::max(brush.bristle_px, stroke.radius_px / 6)) {}

  struct Paint {
    float cover, share, tone;
  };
  Paint at(const OnStroke& place) const {
    const BrushProfile profile(stroke_.radius_px);
    const float share = std::clamp(place.along / std::max(stroke_.length, 1e-3f), 0.f, 1.f);
    if (!brush_.varies()) return {profile.cover(place.distance), share, 0};
    const float shown = std::clamp((width_ - 0.6f) / 0.9f, 0.f, 1.f), lane = place.across / width_;
    const float ragged = noise(1, place.along / (1.2f * stroke_.radius_px) + (place.across > 0 ? 40.f : 0.f));
    const float inside = profile.middle_px * (1 - 0.12f * shown * ragged) - place.distance;
    float cover = inside / profile.rim_px + 0.5f;
    const float beyond = std::sqrt(std::max(place.distance * place.distance - place.across * place.across, 0.f));
    if (brush_.dry > 0 && stroke_.length > 2 * stroke_.radius_px) {
      cover = std::min(cover, 1 - (place.along - stroke_.length * (1 - brush_.dry * noise(2, lane))) / (1.5f * width_));
      const float reach = 1 - shown * (0.3f + 0.5f * noise(5, lane + (share > 0.5f ? 60.f : 0.f)));
      cover = std::min(cover, 1 - (beyond - reach * stroke_.radius_px) / width_);
    }
    const float broad = noise(4, lane / 2.3f + place.along / (3 * stroke_.radius_px)) - 0.5f;
    float tone = shown * brush_.streaks * (0.8f * (noise(3, lane) - 0.5f) + 0.6f * broad);
    tone += shown * brush_.ridge * std::max(1 - 2 * beyond / stroke_.radius_px, 0.f) *
            std::clamp(1 - inside / (1.2f * width_), 0.f, 1.f) *
            std::copysign(place.facing, place.facing * place.across);
    cover = std::clamp(cover, 0.f, 1.f);
    if (brush_.picture.empty() || stroke_.length <= 2 * stroke_.radius_px) return {cover, share, tone};
    const float pictured = std::clamp((stroke_.radius_px - 1) / 2, 0.f, 1.f), bare = 1 - of_picture(place);
    if (brush_.dry > 0) cover *= 1 - pictured * bare;
    return {cover, share, tone + pictured * brush_.streaks * (0.25f - bare)};
  }

 private:
  /// The cover of the brush's picture, 0..1, between four pixels of the level for the stroke's width.
  float of_picture(const OnStroke& place) const {
    const BrushPicture::Level& level = BrushPicture::sizes[static_cast<std::size_t>(brush_level(stroke_.radius_px))];
    const int columns = level.columns, rows = level.rows;
    const float side = stroke_.seed % 2 == 1 ? -1.f : 1.f;
    const float x = (place.along + stroke_.radius_px) / (stroke_.length + 2 * stroke_.radius_px);
    const float y = (1 + side * place.across / stroke_.radius_px) / 2;
    const auto pixel = [&](int column, int row) {
      const std::size_t at = level.first + static_cast<std::size_t>(row * columns + column);
      return static_cast<float>(brush_.picture.levels[at]) / 255;
    };
    const float column = std::clamp(x * static_cast<float>(columns) - 0.5f, 0.f, static_cast<float>(columns - 1));
    const float row = std::clamp(y * static_cast<float>(rows) - 0.5f, 0.f, static_cast<float>(rows - 1));
    const int left = static_cast<int>(column), top = static_cast<int>(row);
    const int right = std::min(left + 1, columns - 1), bottom = std::min(top + 1, rows - 1);
    return std::lerp(std::lerp(pixel(left, top), pixel(right, top), column - static_cast<float>(left)),
                     std::lerp(pixel(left, bottom), pixel(right, bottom), column - static_cast<float>(left)),
                     row - static_cast<float>(top));
  }

  float noise(std::uint32_t which, float place) const {
    const float cell = std::floor(place), part = place - cell, weight = part * part * (3 - 2 * part);
    const auto lattice = [&](std::int32_t point) {
      std::uint32_t h = static_cast<std::uint32_t>(point) * 0x9e3779b9u + stroke_.seed + which * 0x85ebca6bu;
      h = (h ^ h >> 16) * 0x7feb352du;
      h = (h ^ h >> 15) * 0x846ca68bu;
      return static_cast<float>((h ^ h >> 16) >> 8) * 0x1p-24f;
    };
    const auto point = static_cast<std::int32_t>(cell);
    return lattice(point) + weight * (lattice(point + 1) - lattice(point));
  }

  const FlatStroke& stroke_;
  const Brush& brush_;
  float width_;
};

/// The slow, obvious way: every pixel's distance to every segment.
Image<Rgb8> draw_plainly(const StrokePainting& painting, ViewPosition view) {
  Image<Rgb8> picture(painting.width, painting.height);
  std::vector<FlatLayer> layers;
  for (const Layer& layer : painting.layers) layers.push_back(flatten(layer));
  std::vector<SeenLayer> seen;
  for (const FlatLayer& layer : layers) seen.emplace_back(layer, view);
  for (int y = 0; y < painting.height; ++y) {
    for (int x = 0; x < painting.width; ++x) {
      const Rgb8 canvas = painting.canvas_colour;
      float red = canvas.r, green = canvas.g, blue = canvas.b;
      for (const SeenLayer& layer : seen) {
        Brush brush = painting.brush;
        if (&layer == &seen.front()) brush.dry = 0;
        for (const FlatStroke& stroke : layer.flat.strokes) {
          OnStroke nearest;
          for (std::uint32_t i = 0; i < stroke.vertex_count; ++i) {
            const std::size_t to = stroke.first_vertex + i, from = i == 0 ? to : to - 1;
            const float dx = layer.x(to) - layer.x(from), dy = layer.flat.y[to] - layer.flat.y[from];
            const float px = static_cast<float>(x) + 0.5f - layer.x(from),
                        py = static_cast<float>(y) + 0.5f - layer.flat.y[from];
            const float squared = dx * dx + dy * dy;
            const float t = squared > 0 ? std::clamp((px * dx + py * dy) / squared, 0.f, 1.f) : 0;
            const float distance = std::hypot(px - t * dx, py - t * dy);
            if (distance >= nearest.distance || (i == 0 && stroke.vertex_count > 1)) continue;
            const float unbound = squared > 0 ? (px * dx + py * dy) / squared : 0;
            const float length = std::sqrt(squared), least = i == 1 ? -INFINITY : 0;
            const float most = i + 1 == stroke.vertex_count ? INFINITY : 1;
            const float course_x = squared > 0 ? dx / length : 1, course_y = squared > 0 ? dy / length : 0;
            nearest = {distance,
                       layer.flat.along[from] +
                           std::clamp(unbound, least, most) * (layer.flat.along[to] - layer.flat.along[from]),
                       course_x * py - course_y * px, 0.6f * course_y - 0.8f * course_x};
          }
          const PlainBristles::Paint paint = PlainBristles(stroke, brush).at(nearest);
          const float alpha = stroke.opacity * paint.cover;
          const auto lay = [&](float own, float change, float& level) {
            level += (std::clamp(own + paint.share * change + paint.tone, 0.f, 255.f) - level) * alpha;
          };
          lay(stroke.red, stroke.red_change, red);
          lay(stroke.green, stroke.green_change, green);
          lay(stroke.blue, stroke.blue_change, blue);
        }
      }
      const auto byte = [](float value) { return static_cast<std::uint8_t>(value + 0.5f); };
      picture(x, y) = {byte(red), byte(green), byte(blue)};
    }
  }
  return picture;
}

StrokePainting painting_of(int width, int height, float opacity) {
  return {width,
          height,
          {240, 230, 220},
          {random_layer(width, height, 150, opacity), random_layer(width, height, 80, opacity)}};
}

/// All pixels and channels.
double mean_difference(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::abs(p.r - q.r) + std::abs(p.g - q.g) + std::abs(p.b - q.b);
  }
  return sum / (3.0 * static_cast<double>(a.pixels().size()));
}

/// A surface that hides the left half of what lies farther than 4 pixels of disparity.
Image<float> surface_to_the_left(int width, int height) {
  Image<float> surface(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width / 2; ++x) surface(x, y) = 4;
  return surface;
}

TEST(Rasteriser, TellsWhatStrokesLeaveBareAsACanvasWould) {
  for (const auto& [width, height] : {std::pair{97, 71}, {1, 1}, {16, 33}, {130, 64}}) {
    const Image<float> surface = surface_to_the_left(width, height);
    const Hiding hiding{.surface = surface, .tolerance_px = 1};
    for (const float opacity : {1.f, 0.5f}) {
      const Layer layer = random_layer(width, height, 40, opacity);
      Canvas canvas(width, height, {});
      Image<std::uint8_t> bare(width, height);
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) bare(x, y) = (x / 5 + y / 7) % 3 == 0 || y >= 64 ? 0 : 255;
      rasterise(layer, central_view, hiding, canvas);
      const Image<std::uint8_t> left = left_bare(layer, central_view, hiding, bare);
      int was_bare = 0, is_bare = 0, differs = 0;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          was_bare += bare(x, y) != 0;
          is_bare += left(x, y) != 0;
          differs += (left(x, y) != 0) != (bare(x, y) != 0 && canvas.coverage(x, y) < 0.5f);
        }
      EXPECT_EQ(differs, 0) << width << "x" << height << " opacity " << opacity;
      if (width == 97) {
        EXPECT_TRUE(0 < is_bare && is_bare < was_bare) << is_bare << " of " << was_bare;
      }
    }
  }
}

TEST(Rasteriser, DrawsWhatTheObviousWayDraws) {
  for (const auto& [width, height] : {std::pair{97, 71}, {1, 1}, {16, 33}, {130, 5}}) {
    for (const float opacity : {1.f, 0.5f}) {
      const StrokePainting painting = painting_of(width, height, opacity);
      EXPECT_LE(
          largest_difference(draw(Painting{painting}, central_view).picture, draw_plainly(painting, central_view)), 1)
          << width << "x" << height << " opacity " << opacity;
    }
  }
}

StrokePainting bristly_painting_of(int width, int height) {
  StrokePainting painting = painting_of(width, height, 1);
  for (Layer& layer : painting.layers)
    for (Stroke& stroke : layer.strokes)
      stroke.change = {40, static_cast<std::int16_t>(-stroke.colour.g / 2),
                       static_cast<std::int16_t>(stroke.colour.r / 4)};
  painting.brush = {.bristle_px = 1.4f, .streaks = 30, .ridge = 20, .dry = 0.6f};
  return painting;
}

TEST(Bristles, AreThoseOfTheObviousWay) {
  for (const auto& [width, height] : {std::pair{97, 71}, {1, 1}, {16, 33}, {130, 5}}) {
    StrokePainting painting = bristly_painting_of(width, height);
    // Tones are kept in half levels, and a place where two segments are equally near may be either's.
    const Image<Rgb8> drawn = draw(Painting{painting}, central_view).picture,
                      plain = draw_plainly(painting, central_view);
    EXPECT_LE(mean_difference(drawn, plain), width > 1 ? 0.4 : 1) << width << "x" << height;
    const StrokePainting even = painting_of(width, height, 1);
    if (width > 16) {
      EXPECT_GE(mean_difference(drawn, draw_plainly(even, central_view)), 5);
    }
  }
}

TEST(Bristles, ThatAPictureTellsAreThoseOfTheObviousWay) {
  StrokePainting painting = bristly_painting_of(97, 71);
  const Image<Rgb8> without = draw(Painting{painting}, central_view).picture;
  for (const float bristle_px : {1.4f, 0.f}) {
    for (const float dry : {0.6f, 0.f}) {
      painting.brush = {.bristle_px = bristle_px, .streaks = 30, .dry = dry, .picture = built_in_brush("fan")};
      const Image<Rgb8> drawn = draw(Painting{painting}, central_view).picture;
      EXPECT_LE(mean_difference(drawn, draw_plainly(painting, central_view)), 0.4) << bristle_px << ' ' << dry;
      EXPECT_GE(mean_difference(drawn, without), 3) << bristle_px << ' ' << dry;
    }
  }
}

TEST(Bristles, OfAStrokeAreTheSameInAllViews) {
  StrokePainting painting = bristly_painting_of(130, 97);
  for (Layer& layer : painting.layers)
    for (ControlPoint& point : layer.points) point.disparity = 8;
  const Image<Rgb8> left = draw(Painting{painting}, left_eye).picture,
                    right = draw(Painting{painting}, right_eye).picture;
  int differing = 0;
  for (int y = 0; y < 97; ++y)
    for (int x = 0; x < 122; ++x) differing += left(x + 8, y) != right(x, y);
  EXPECT_EQ(differing, 0);
}

TEST(Bristles, DoNotSparkleWhenAPictureIsDrawnSmall) {
  const Painting painting{bristly_painting_of(240, 160)};
  StrokePainting even = bristly_painting_of(240, 160);
  even.brush = {};
  const Placement small{.scale = 0.25};
  EXPECT_LE(mean_difference(draw(placed(painting, small), central_view).picture,
                            draw(placed(Painting{even}, small), central_view).picture),
            mean_difference(draw(painting, central_view).picture, draw(Painting{even}, central_view).picture) / 2);
}

// Strokes are made once, in the central view; at fractions of a pixel their rims are interpolated.
TEST(Rasteriser, DrawsOtherViewsWithinATwentiethOfAPixelOfTheObviousWay) {
  const StrokePainting painting = painting_of(130, 97, 1);
  StrokePainting beside = painting;
  for (Layer& layer : beside.layers)
    for (ControlPoint& point : layer.points) point.x += 0.05f;
  for (const float position : {-0.5f, -0.33f, 0.21f, 0.5f}) {
    const ViewPosition view(position);
    const Image<Rgb8> plainly = draw_plainly(painting, view);
    const double off = mean_difference(draw(Painting{painting}, view).picture, plainly);
    EXPECT_LE(off, mean_difference(draw_plainly(beside, view), plainly)) << position;
    EXPECT_LE(largest_difference(draw(Painting{painting}, view).picture, plainly), 48) << position;
  }
}

TEST(Rasteriser, DrawsTheSameWithEveryInstructionSet) {
  const StrokePainting painting = painting_of(97, 71, 0.7f);
  const Image<Rgb8> best = draw(Painting{painting}, left_eye).picture;
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    // Fused multiplications round the places of strokes otherwise.
    EXPECT_LE(largest_difference(draw(Painting{painting}, left_eye).picture, best), 4) << hwy::TargetName(target);
    EXPECT_LE(mean_difference(draw(Painting{painting}, left_eye).picture, best), 0.02) << hwy::TargetName(target);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(Rasteriser, GivesTheSameBytesOnAnyNumberOfThreads) {
  const StrokePainting painting = painting_of(300, 200, 0.7f);
  Image<Rgb8> first;
  for (const std::size_t threads : {1u, 2u, 5u}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    const Image<Rgb8> picture = draw(Painting{painting}, right_eye).picture;
    if (first.empty()) first = picture;
    EXPECT_EQ(picture, first);
  }
}

TEST(Rasteriser, DrawsAViewAloneAsAmongMany) {
  for (const float opacity : {1.f, 0.6f}) {
    const PreparedPainting painting = prepare(Painting{painting_of(150, 90, opacity)});
    std::vector<ViewPosition> views;
    for (int i = 0; i < 9; ++i) views.emplace_back(0.25f * static_cast<float>(i) - 1);
    const std::vector<DrawnView> many = draw(painting, views);
    for (std::size_t i = 0; i + 1 < views.size(); ++i) {
      EXPECT_EQ(largest_difference(draw(painting, views[i]).picture, many[i].picture), 0) << i;
      const std::vector<DrawnView> two = draw(painting, std::span(views).subspan(i, 2));
      EXPECT_EQ(largest_difference(two[0].picture, many[i].picture), 0) << i;
      EXPECT_EQ(largest_difference(two[1].picture, many[i + 1].picture), 0) << i;
    }
  }
}

void append(const Layer& strokes, Layer& layer) {
  for (Stroke stroke : strokes.strokes) {
    stroke.first_point += static_cast<std::uint32_t>(layer.points.size());
    layer.strokes.push_back(stroke);
  }
  layer.points.insert(layer.points.end(), strokes.points.begin(), strokes.points.end());
}

TEST(Rasteriser, DrawsOverAViewWhatItDrawsWithAllStrokes) {
  constexpr int width = 150, height = 90;
  const Image<Rgb8> photograph(width, height, {20, 120, 220});
  for (const ViewPosition view : {central_view, right_eye, ViewPosition(2.f)}) {
    for (const auto& [background, canvas_shows] :
         {std::pair{ImageView<const Rgb8>(photograph), false}, {ImageView<const Rgb8>(), true}, {{}, false}}) {
      StrokePainting painting = painting_of(width, height, 0.6f);
      painting.canvas_shows = canvas_shows;
      PreparedPainting prepared = prepare(Painting{painting}, {.deep = true});
      DrawnView drawn = draw(prepared, view, background);
      for (const int count : {7, 1}) {
        const Layer added = random_layer(width, height, count, 0.6f);
        append(added, painting.layers.back());
        draw_over(prepared, added, view, background, drawn);
        const DrawnView whole = draw(prepare(Painting{painting}, {.deep = true}), view, background);
        EXPECT_EQ(drawn.picture, whole.picture);
        EXPECT_EQ(drawn.deep, whole.deep);
        EXPECT_EQ(drawn.bare, whole.bare);
        EXPECT_EQ(drawn.bare_share, whole.bare_share);
      }
    }
  }
}

TEST(Rasteriser, DrawsLayerByLayerWhatItDrawsFromTheFront) {
  const StrokePainting painting = painting_of(200, 150, 0.6f);
  Canvas canvas(200, 150, painting.canvas_colour);
  for (const Layer& layer : painting.layers) rasterise(layer, central_view, {}, canvas);
  const Image<Rgb8> whole = draw(Painting{painting}, central_view).picture;
  for (int y = 0; y < 150; ++y) {
    for (int x = 0; x < 200; ++x) {
      EXPECT_NEAR(canvas.red(x, y), whole(x, y).r, 1);
      EXPECT_NEAR(canvas.green(x, y), whole(x, y).g, 1);
    }
  }
}

TEST(Rasteriser, CoversAPixelOnceWhereAStrokeCrossesItself) {
  Layer layer;
  layer.radius_px = 6;
  for (const auto& [x, y] : {std::pair{10.f, 30.f}, {50.f, 30.f}, {10.f, 30.f}, {50.f, 30.f}})
    layer.points.push_back({x, y, 0});
  layer.strokes.push_back({.first_point = 0, .point_count = 4, .radius_px = 6, .opacity = 0.5f, .colour = {0, 0, 0}});
  const Image<Rgb8> picture = draw(Painting{StrokePainting{60, 60, {200, 200, 200}, {layer}}}, left_eye).picture;
  EXPECT_EQ(picture(30, 30).r, 100);
}

TEST(Rasteriser, ShiftsAStrokeByItsDisparity) {
  Layer layer;
  layer.radius_px = 3;
  layer.points.push_back({30.5f, 10.5f, 8});
  layer.strokes.push_back({.point_count = 1, .radius_px = 3, .colour = {255, 0, 0}, .disparity = 8});
  const StrokePainting painting{60, 21, {0, 0, 0}, {layer}};
  EXPECT_EQ(draw(Painting{painting}, left_eye).picture(30, 10).r, 255);
  EXPECT_EQ(draw(Painting{painting}, right_eye).picture(22, 10).r, 255);
  EXPECT_EQ(draw(Painting{painting}, right_eye).picture(30, 10).r, 0);
  EXPECT_EQ(draw(Painting{painting}, central_view).picture(26, 10).r, 255);
}

TEST(Rasteriser, LeavesAStrokeOutOfTheViewsThatMayNotShowIt) {
  Layer layer;
  layer.points.push_back({30.5f, 10.5f, 0});
  layer.strokes.push_back({.point_count = 1, .radius_px = 3, .colour = {255, 0, 0}, .views = {left_eye, left_eye}});
  const StrokePainting painting{60, 21, {0, 0, 0}, {layer}};
  EXPECT_EQ(draw(Painting{painting}, left_eye).picture(30, 10).r, 255);
  EXPECT_EQ(draw(Painting{painting}, right_eye).picture(30, 10).r, 0);
}

TEST(Rasteriser, CountsWhatIsBare) {
  StrokePainting painting{40, 40, {0, 0, 0}, {}};
  EXPECT_DOUBLE_EQ(draw(Painting{painting}, left_eye).bare_share, 1);
  Layer layer;
  layer.points.push_back({20, 20, 0});
  layer.strokes.push_back({.point_count = 1, .radius_px = 60, .colour = {255, 0, 0}});
  painting.layers.push_back(layer);
  EXPECT_DOUBLE_EQ(draw(Painting{painting}, left_eye).bare_share, 0);
}

TEST(Rasteriser, DrawsColoursBetweenTwoLevelsWithSixteenBits) {
  constexpr int count = 64, apart = 12;
  Layer layer;
  for (int i = 0; i < count; ++i) {
    const auto fine = static_cast<std::int8_t>(2 * i);  // steps of a level
    layer.points.push_back({static_cast<float>(apart * i + 6), 6, 0});
    layer.strokes.push_back({.first_point = static_cast<std::uint32_t>(i),
                             .point_count = 1,
                             .radius_px = 5,
                             .colour = {100, 0, 200},
                             .fine = {{fine, 0, fine}, {fine, 0, fine}}});
  }
  const Painting painting{StrokePainting{apart * count, 12, {0, 0, 0}, {layer}}};
  const DrawnView drawn = draw(prepare(painting, {.deep = true}), left_eye);
  for (int i = 0; i < count; ++i) {
    const float above = 2 * static_cast<float>(i) / FineColour::steps_a_level;
    const Rgb16 deep = drawn.deep(apart * i + 6, 6);
    EXPECT_NEAR(deep.r, (100 + above) * deep_level, 1) << i;
    EXPECT_NEAR(deep.b, (200 + above) * deep_level, 1) << i;
    EXPECT_EQ(drawn.picture(apart * i + 6, 6).r, above < 0.5f ? 100 : 101) << i;
  }
  EXPECT_TRUE(draw(prepare(painting), left_eye).deep.empty());
}

TEST(Rasteriser, DrawsThePictureOfSixteenBitsThatRoundsToTheOneOfEight) {
  for (const bool canvas_shows : {true, false}) {
    Painting painting{StrokePainting{150, 70, {200, 190, 180}, {random_layer(150, 70, 60, 0.7f)}}};
    std::get<StrokePainting>(painting.marks).canvas_shows = canvas_shows;
    painting.relief = {1.5f, 3};
    const PreparedPainting prepared = prepare(painting, {.deep = true});
    for (const ViewPosition view : {left_eye, ViewPosition(0.8f)}) {
      const DrawnView drawn = draw(prepared, view);
      ASSERT_TRUE(same_size(drawn.deep, drawn.picture));
      int off = 0;
      for (std::size_t i = 0; i < drawn.deep.pixels().size(); ++i) {
        const Rgb16 deep = drawn.deep.pixels()[i];
        const Rgb8 level = drawn.picture.pixels()[i];
        // What was rounded before it was lit may come out more than half a level apart.
        for (const auto& [a, b] : {std::pair{deep.r, level.r}, {deep.g, level.g}, {deep.b, level.b}}) {
          EXPECT_NEAR(static_cast<float>(a) / deep_level, b, 1.3) << i;
          if (std::abs(static_cast<float>(a) / deep_level - static_cast<float>(b)) > 0.51f) ++off;
        }
      }
      EXPECT_LT(off, 150 * 70 * 3 / 4);
      EXPECT_EQ(drawn.picture, draw(prepare(painting), view).picture);
    }
  }
}

TEST(BrushProfile, IsADiscWithASoftRimOfATenthOfItsRadius) {
  const BrushProfile brush(20);
  EXPECT_FLOAT_EQ(brush.cover(17.9f), 1);
  EXPECT_NEAR(brush.cover(19), 0.5f, 1e-5f);
  EXPECT_FLOAT_EQ(brush.cover(20.1f), 0);
}

}  // namespace wheatstone::rasterise_test
