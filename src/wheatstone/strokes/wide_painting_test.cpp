#include "wheatstone/strokes/wide_painting.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <cmath>

#include "throws_error.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone {
namespace {

const SyntheticStillOptions still_options{.width = 320, .height = 240, .samples_a_side = 1};
std::vector<ViewPosition> positions_at(std::initializer_list<float> eye_separations) {
  std::vector<ViewPosition> positions;
  for (const float v : eye_separations) positions.emplace_back(v);
  return positions;
}

constexpr ViewRange range{ViewPosition(-1.25f), ViewPosition(1.25f)};

const SyntheticStill& still() {
  static const SyntheticStill made = make_synthetic_still(still_options);
  return made;
}

StrokePainting planned() { return plan_painting(still().pictures, still().geometry, {}).strokes; }

const WidePainting& wide() {
  static const WidePainting made = widen(planned(), still().pictures, still().geometry, {}, range);
  return made;
}

double rms(const Image<Rgb8>& a, const Image<Rgb8>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const Rgb8 p = a.pixels()[i], q = b.pixels()[i];
    sum += std::pow(p.r - q.r, 2) + std::pow(p.g - q.g, 2) + std::pow(p.b - q.b, 2);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a.pixels().size())));
}

TEST(WidePainting, ViewsBesideTheEyesAreAsTrueAsTheEyes) {
  const double eye = rms(draw(wide(), left_eye).picture, still().pictures.left);
  // The naive way: all strokes, wherever they are drawn, whatever hides them, and none for what comes into sight.
  StrokePainting naive = planned();
  for (Layer& layer : naive.layers)
    for (Stroke& stroke : layer.strokes) stroke.views = range;
  for (const float position : {-1.25f, -0.8f, 0.f, 0.3f, 1.25f}) {
    const ViewPosition view(position);
    const Image<Rgb8> truth = make_synthetic_view(still_options, view).picture;
    const double ours = rms(draw(wide(), view).picture, truth);
    EXPECT_LT(ours, 1.35 * eye) << position;
    if (view > range.first && view < range.last) continue;
    EXPECT_GT(rms(draw(naive, view).picture, truth), 1.3 * ours) << position;
  }
}

TEST(WidePainting, NoViewIsLeftBare) {
  for (const float position : {-1.25f, -0.9f, 0.f, 0.7f, 1.25f})
    EXPECT_LT(draw(wide(), ViewPosition(position)).bare_share, 0.002) << position;
  const std::vector<ViewPosition> positions = positions_at({-1.25f, -1.f, -0.2f, 0.2f, 0.6f, 1.1f});
  for (const DrawnView& view : draw_views(wide(), positions)) EXPECT_LT(view.bare_share, 0.004);
}

TEST(WidePainting, ManyViewsAreWhatStrokesDrawnForEachWouldBe) {
  const std::vector<ViewPosition> positions = positions_at({-1.25f, -0.9f, -0.5f, -0.2f, 0.f, 0.4f, 0.8f, 1.25f});
  const std::vector<DrawnView> many = draw_views(wide(), positions);
  ASSERT_EQ(many.size(), positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Image<Rgb8> one = draw(wide(), positions[i]).picture;
    EXPECT_LT(rms(many[i].picture, one), 7) << positions[i].eye_separations();
    // A view that is a quarter of an eye separation off is far worse.
    const float position = positions[i].eye_separations();
    const ViewPosition beside(position - std::copysign(0.25f, position));
    EXPECT_GT(rms(many[i].picture, draw(wide(), beside).picture), 10);
  }
}

TEST(WidePainting, TheSameOnAnyNumberOfThreads) {
  const std::vector<ViewPosition> positions = positions_at({-0.7f, 0.1f, 1.f});
  const std::vector<DrawnView> many = draw_views(wide(), positions);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const std::vector<DrawnView> alone =
      draw_views(widen(planned(), still().pictures, still().geometry, {}, range), positions);
  for (std::size_t i = 0; i < positions.size(); ++i) EXPECT_EQ(many[i].picture, alone[i].picture);
}

TEST(WidePainting, NeedsStrokesThatArePropagated) {
  Style style;
  style.propagation = Propagation::independent;
  expect_error(ErrorKind::wrong_usage, "propagation",
               [&] { widen(planned(), still().pictures, still().geometry, style, range); });
}

}  // namespace
}  // namespace wheatstone
