#include "wheatstone/app/render_model_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/marks/style.h"
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

}  // namespace wheatstone::model_pictures_test
