#include "wheatstone/app/model_pictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <variant>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/measures/film_measures.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/synthetic/synthetic_models.h"

namespace wheatstone::model_pictures_test {

ReadyModel ready(Model model) {
  ReadyModel made{.read = {.model = std::move(model), .format = "made"}};
  const ModelBounds bounds = bounds_of(made.read.model);
  made.origin = bounds.middle();
  made.radius = static_cast<float>(bounds.radius());
  return made;
}

RenderParticlesOptions small_pictures() {
  RenderParticlesOptions options;
  options.framing.zoom = 1.2f;
  options.width = 240;
  options.height = 180;
  options.depth.near_mm = 55;
  options.depth.far_mm = 60;
  return options;
}

/// Share of a view's pixels that neither are wanted of a view nor shown by those before it, by moving each of their
/// pixels to it.
double share_missing(const ModelPictures& made, std::size_t view) {
  const View& to = made.known[view];
  Image<std::uint8_t> shown(to.disparity.width(), to.disparity.height());
  const auto move = [&](ImageView<const float> disparity, ViewPosition position) {
    for (int y = 0; y < disparity.height(); ++y)
      for (int x = 0; x < disparity.width(); ++x) {
        const float d = disparity(x, y);
        const float place = static_cast<float>(x) + 0.5f - (to.position - position) * d;
        for (const float beside : {-0.5f, 0.f, 0.5f}) {
          const int column = static_cast<int>(std::floor(place + beside));
          if (to.disparity.contains(column, y) && std::abs(to.disparity(column, y) - d) <= 1.5f) shown(column, y) = 255;
        }
      }
  };
  move(made.left_disparity, left_eye);
  for (std::size_t v = 0; v < view; ++v) move(made.known[v].disparity, made.known[v].position);
  std::size_t missing = 0;
  for (int y = 0; y < shown.height(); ++y)
    for (int x = 0; x < shown.width(); ++x) missing += shown(x, y) == 0 && to.wanted(x, y) == 0 ? 1 : 0;
  return static_cast<double>(missing) / static_cast<double>(shown.pixels().size());
}

double share_wanted(const View& view) {
  std::size_t count = 0;
  for (int y = 0; y < view.wanted.height(); ++y)
    count += static_cast<std::size_t>(std::ranges::count_if(view.wanted.row(y), [](auto m) { return m != 0; }));
  return static_cast<double>(count) / (static_cast<double>(view.wanted.width()) * view.wanted.height());
}

TEST(ModelPictures, TheViewsTogetherShowAllThatEachShows) {
  for (const Model& model : {make_knot(5000), make_tree(5000), make_city(3000)}) {
    const ModelPictures made = model_pictures(ready(model), small_pictures(), widest_views);
    ASSERT_EQ(made.known.size(), 6u);
    for (std::size_t v = 0; v < made.known.size(); ++v) {
      EXPECT_LE(share_missing(made, v), 0.01) << v;
      EXPECT_LT(share_wanted(made.known[v]), 0.35) << v;
    }
    EXPECT_GT(share_wanted(made.known[0]), 0.005);
  }
}

TEST(ModelPictures, APaintedModelIsBareNowhere) {
  for (const Model& model : {make_knot(5000), make_tree(5000)}) {
    ModelPictures made = model_pictures(ready(model), small_pictures(), widest_views);
    PaintPhotographOptions options{.style = style_by_name("oil")};
    options.left_disparity = std::move(made.left_disparity);
    options.right_disparity = std::move(made.right_disparity);
    options.known = std::move(made.known);
    const PaintedPhotograph painted = paint_photograph(made.pictures, options);
    Presentation presentation;
    for (int v = -4; v <= 4; ++v) presentation.views.emplace_back(static_cast<float>(v) / 2);
    const Presented shown = present(painted.painted.painting, presentation);
    RecordProperty("worst_bare_percent", std::to_string(100 * shown.worst_bare_share));
    EXPECT_LE(shown.worst_bare_share, 1e-3);
  }
}

ParticleFramesOptions turntable(int frames_a_turn) {
  ParticleFramesOptions options{.particles = small_pictures(), .count = frames_a_turn, .orbit_deg = 360};
  options.particles.framing.zoom = 1;
  return options;
}

/// A vertex in the left eye's picture.
struct SeenVertex {
  float x, y, disparity;
};
SeenVertex seen_vertex(const ReadyModel& model, std::size_t vertex, const ParticleFramesOptions& film, int frame) {
  const ModelScene scene = scene_of(model, options_of_frame(film, frame, {}));
  const Camera& camera = scene.camera;
  std::array<double, 3> offset{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    offset[axis] = model.read.model.positions[vertex][axis] - model.origin[axis] - camera.position[axis];
  const auto along = [&](const std::array<float, 3>& direction) {
    return static_cast<float>(offset[0] * direction[0] + offset[1] * direction[1] + offset[2] * direction[2]);
  };
  const float depth = along(camera.forward), disparity = -parallax_px(scene.mapping, depth);
  return {camera.centre_x_px + camera.focal_px * along(camera.right) / depth + disparity / 2,
          camera.centre_y_px + camera.focal_px * along(camera.down) / depth, disparity};
}

TEST(ModelFilm, FlowLeadsEveryVertexToItsPlaceInTheOtherFrame) {
  const ReadyModel model = ready(make_knot(5000));
  const ParticleFramesOptions film = turntable(48);
  const KnownFrame now = film_of_model(model, film, {24, 1}).known(5, {});
  int seen = 0;
  double sum_px = 0, moved_px = 0;
  for (std::size_t v = 0; v < model.read.model.positions.size(); ++v) {
    const SeenVertex at = seen_vertex(model, v, film, 5), before = seen_vertex(model, v, film, 4);
    const int x = static_cast<int>(std::floor(at.x)), y = static_cast<int>(std::floor(at.y));
    // Hidden vertices have another disparity than the pixel shows.
    if (std::abs(now.geometry.left_disparity(x, y) - at.disparity) > 0.02f) continue;
    ++seen;
    sum_px +=
        std::hypot(now.flow->backward.x(x, y) - (before.x - at.x), now.flow->backward.y(x, y) - (before.y - at.y));
    moved_px += std::hypot(before.x - at.x, before.y - at.y);
  }
  ASSERT_GT(seen, 300);
  EXPECT_GT(moved_px / seen, 2);
  EXPECT_LT(sum_px / seen, 0.05);
}

TEST(ModelFilm, TheWallStandsStill) {
  const ReadyModel model = ready(make_textured_sphere(2000));
  const KnownFrame now = film_of_model(model, turntable(48), {24, 1}).known(1, {});
  EXPECT_EQ(now.flow->forward.x(0, 0), 0);
  EXPECT_EQ(now.flow->backward.y(2, 90), 0);
  EXPECT_GT(std::abs(now.flow->forward.x(120, 90)), 1);
}

TEST(ModelFilm, SkippedFramesChangeNothing) {
  const ReadyModel model = ready(make_knot(1000));
  ModelFilm whole = film_of_model(model, turntable(12), {24, 1}), later = film_of_model(model, turntable(12), {24, 1});
  StereoFrame expected, frame;
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(whole.source.read(expected));
  EXPECT_EQ(later.source.skip(2), 2);
  ASSERT_TRUE(later.source.read(frame));
  EXPECT_EQ(frame.left, expected.left);
  EXPECT_EQ(frame.pts, 2);
  EXPECT_EQ(later.known(2, {frame.left, frame.right}).flow->forward.x,
            whole.known(2, {expected.left, expected.right}).flow->forward.x);
  EXPECT_EQ(later.source.skip(100), 9);
  EXPECT_FALSE(later.source.read(frame));
}

ModelFilm larger_turntable(const Model& model) {
  ParticleFramesOptions film = turntable(96);
  film.particles.width = 480;
  film.particles.height = 360;
  return film_of_model(ready(model), film, {24, 1});
}

RotoscopeOptions options_on_models() {
  RotoscopeOptions options{.style = style_by_name("impressionist")};
  options.carrying.length_tolerance = length_tolerance_on_models;
  return options;
}

/// What becomes of the strokes of a painted turntable.
struct PaintedTurntable {
  double survival = 0;
  double of_source = 0, of_painting = 0;  ///< temporal errors
  double worst_bare_share = 0;
};
PaintedTurntable paint_turntable(const Model& model, int frames, bool anew) {
  ModelFilm made = larger_turntable(model);
  RotoscopeState state;
  RotoscopeOptions options = options_on_models();
  options.anew = anew;
  PaintedTurntable result;
  TemporalError of_source, of_painting;
  Image<Rgb8> source_before, painted_before;
  StereoFrame frame;
  for (int i = 0; i < frames && made.source.read(frame); ++i) {
    const KnownFrame known = made.known(i, {frame.left, frame.right});
    const RotoscopedFrame painted = rotoscope_frame({frame.left, frame.right}, options, state, &known);
    const Image<Rgb8>& left = std::get<StereoPair>(painted.pictures).left;
    if (i > 0) {
      const FramePair pair = relate_frames(*known.flow);
      of_source.add(source_before, frame.left, pair);
      of_painting.add(painted_before, left, pair);
    }
    source_before = frame.left;
    painted_before = left;
    result.worst_bare_share = std::max(result.worst_bare_share, painted.worst_bare_share);
  }
  result.of_source = of_source.mean();
  result.of_painting = of_painting.mean();
  result.survival =
      static_cast<double>(state.totals.survived_strokes) / static_cast<double>(state.totals.whole_strokes);
  return result;
}

TEST(ModelFilm, StrokesStickToAModelThatTurns) {
  for (const Model& model : {make_knot(5000), make_tree(5000)}) {
    const PaintedTurntable painted = paint_turntable(model, 6, false), anew = paint_turntable(model, 2, true);
    EXPECT_GE(painted.survival, 0.92);
    EXPECT_LE(painted.worst_bare_share, 1e-3);
    EXPECT_LT(painted.of_painting, 0.6 * anew.of_painting);
    RecordProperty("survival", std::to_string(painted.survival));
    RecordProperty("temporal_error", std::to_string(painted.of_painting));
    RecordProperty("temporal_error_of_the_source", std::to_string(painted.of_source));
  }
}

TEST(ModelFilm, ADisplaysViewsAreBareNowhere) {
  for (const Model& model : {make_knot(5000), make_tree(5000)}) {
    ModelFilm made = larger_turntable(model);
    RotoscopeState state;
    RotoscopeOptions options = options_on_models();
    options.display = {
        .views = {.views = 9, .width = 300, .height = 300, .span = 3}, .quilt = QuiltLayout{3, 3}, .screen = {}};
    StereoFrame frame;
    for (int i = 0; i < 3 && made.source.read(frame); ++i) {
      const KnownFrame known = made.known(i, {frame.left, frame.right});
      const RotoscopedFrame painted = rotoscope_frame({frame.left, frame.right}, options, state, &known);
      EXPECT_LE(painted.worst_bare_share, 1e-3) << i;
      RecordProperty("worst_bare_percent", std::to_string(100 * painted.worst_bare_share));
    }
  }
}

}  // namespace wheatstone::model_pictures_test
