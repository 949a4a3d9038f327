// What a painting for two eyes must show, on pictures with known disparity.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "shared_data.h"
#include "spilling_share.h"
#include "wheatstone/app/report.h"
#include "wheatstone/painting/still_scene.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/single_view.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::quality_test {

struct Subject {
  StereoPair photographs;
  Image<float> left_disparity;
  std::optional<Image<float>> right_disparity;
};

std::optional<Subject> shared_subject(const std::string& name, std::optional<float> scale) {
  const std::filesystem::path folder = shared_data() / "stereo" / name;
  if (!std::filesystem::exists(folder)) return {};
  Subject subject{{read_image(folder / "left.png"), read_image(folder / "right.png")},
                  read_disparity(folder / "disp_left.png", scale),
                  {}};
  if (std::filesystem::exists(folder / "disp_right.png"))
    subject.right_disparity = read_disparity(folder / "disp_right.png", scale);
  return subject;
}

const Subject& synthetic_subject() {
  static const Subject made = [] {
    SyntheticStill still = make_synthetic_still({.width = 640, .height = 480});
    return Subject{std::move(still.pictures), std::move(still.geometry.left_disparity),
                   std::move(still.geometry.right_disparity)};
  }();
  return made;
}

PaintedPhotograph painted(const Subject& subject, Propagation propagation) {
  PaintPhotographOptions options;
  options.style.propagation = propagation;
  options.left_disparity = subject.left_disparity;
  options.right_disparity = subject.right_disparity;
  return paint_photograph(subject.photographs, options);
}

void expect_consistent(const Subject& subject) {
  const PaintedPhotograph strokes = painted(subject, Propagation::strokes);
  const PaintingMeasures ours = measure_painting(subject.photographs, strokes, subject.left_disparity);
  const PairMeasures naive =
      measure_pair(painted(subject, Propagation::independent).painted.pictures, subject.left_disparity);

  const double share = ours.painting.difference.mean_absolute / naive.difference.mean_absolute;
  testing::Test::RecordProperty("difference_of_naive", std::to_string(share));
  // Reached: .144 and .149. Strokes that start elsewhere, as with another seed, move it by a few hundredths of itself.
  EXPECT_LE(share, 0.16);
  EXPECT_LE(ours.painting.survival.bad_2, ours.photographs.survival.bad_2 + 0.03);
  EXPECT_GT(naive.survival.bad_2, ours.photographs.survival.bad_2 + 0.10);

  EXPECT_LE(strokes.painted.left_bare_share, 0.005);
  EXPECT_LE(strokes.painted.right_bare_share, 0.005);
  EXPECT_NEAR(ours.painting.left_gradient_energy / ours.painting.right_gradient_energy, 1, 0.05);
  EXPECT_GT(ours.strokes.paired_share, 0.99);
  EXPECT_LT(ours.strokes.shape_differs_share, 0.05);
  EXPECT_LE(ours.wrong_spots.spots_per_100000_px, 5);
  EXPECT_LE(ours.wrong_spots.share, 0.002);
}

/// What a painting's strokes lie on: where the eyes' disparities contradict each other about what only the right eye
/// sees, its own are not followed. That is hardly anywhere.
StereoGeometry surfaces_of(const Subject& subject, StereoGeometry geometry) {
  Image<float> followed = copy_of(make_still_scene(subject.photographs, geometry, widest_views)[1].disparity);
  double differing = 0;
  for (std::size_t i = 0; i < followed.pixels().size(); ++i)
    differing += followed.pixels()[i] != geometry.right_disparity.pixels()[i] ? 1 : 0;
  EXPECT_LE(differing / static_cast<double>(followed.pixels().size()), 0.005);
  geometry.right_disparity = std::move(followed);
  return geometry;
}

/// `untested_share` is what strokes reach that do not look at depth.
void expect_no_spilling(const Subject& subject, double untested_share) {
  PaintedPhotograph result = painted(subject, Propagation::strokes);
  const Style style;
  const float threshold = style.depth_threshold_px * style_scale(style, subject.photographs.left.width());
  const StereoGeometry surfaces = surfaces_of(subject, std::move(result.geometry));
  // What only the right eye sees is planned at half size: a stroke in ten thousand may miss an edge by a pixel.
  EXPECT_LE(spilling_share(layers_of(result.painted.painting).back(), surfaces, threshold), 1e-4);

  PaintPhotographOptions options;
  options.style.depth_test = false;
  options.left_disparity = subject.left_disparity;
  const PaintedPhotograph untested = paint_photograph(subject.photographs, options);
  // Without the test many do, of all strokes, most of which are nowhere near an edge.
  const double spilling = spilling_share(layers_of(untested.painted.painting).back(), untested.geometry, threshold);
  testing::Test::RecordProperty("spilling_untested", std::to_string(spilling));
  EXPECT_GT(spilling, untested_share);
}

TEST(PaintingQuality, SyntheticStillIsConsistent) { expect_consistent(synthetic_subject()); }

// Reached without the depth test: .0068 to .0093 of some ten thousand strokes, by the order in which strokes of one
// depth are drawn, which any change of planning moves. The limit is three standard deviations below the mean.
TEST(PaintingQuality, SyntheticStillDoesNotSpill) { expect_no_spilling(synthetic_subject(), 0.006); }

TEST(PaintingQuality, OfOnePictureAndItsDepthComesNearThatOfAPair) {
  const Subject& pair = synthetic_subject();
  MadePair made = make_pair_from_single_view(pair.photographs.left, pair.left_disparity);
  const Subject single{std::move(made.pictures), pair.left_disparity, std::move(made.geometry.right_disparity)};
  const PaintedPhotograph of_single = painted(single, Propagation::strokes);
  const double ours = measure_left_right_difference(of_single.painted.pictures, pair.left_disparity).mean_absolute;
  const double of_pair =
      measure_left_right_difference(painted(pair, Propagation::strokes).painted.pictures, pair.left_disparity)
          .mean_absolute;
  testing::Test::RecordProperty("of_the_pair", std::to_string(ours / of_pair));
  EXPECT_LE(ours, 1.3 * of_pair);
  EXPECT_LE(of_single.painted.right_bare_share, 0.005);
}

TEST(PaintingQuality, TeddyIsConsistent) {
  const auto teddy = shared_subject("teddy", 4.f);
  if (!teddy) GTEST_SKIP() << "no shared data: teddy";
  expect_consistent(*teddy);
}

// Broad strokes are planned in smaller pictures, which lack the last row of Teddy's 375.
TEST(PaintingQuality, TeddyInOilIsPaintedToItsLastRow) {
  const auto teddy = shared_subject("teddy", 4.f);
  if (!teddy) GTEST_SKIP() << "no shared data: teddy";
  PaintPhotographOptions options;
  options.style = style_by_name("oil");
  options.left_disparity = teddy->left_disparity;
  const PaintedPair painted = paint_photograph(teddy->photographs, options).painted;
  EXPECT_LE(painted.left_bare_share, 6e-4);
  EXPECT_LE(painted.right_bare_share, 6e-4);
}

TEST(PaintingQuality, TeddyDoesNotSpill) {
  const auto teddy = shared_subject("teddy", 4.f);
  if (!teddy) GTEST_SKIP() << "no shared data: teddy";
  expect_no_spilling(*teddy, 0.0135);  // reached: .0159 to .0209, in the same way
}

TEST(PaintingQuality, MotorcycleKeepsItsDepthWithOurOwnMatching) {
  const auto motorcycle = shared_subject("motorcycle", {});
  if (!motorcycle) GTEST_SKIP() << "no shared data: motorcycle";
  const PaintedPhotograph result = paint_photograph(motorcycle->photographs, {});
  const PairMeasures measures = measure_pair(result.painted.pictures, motorcycle->left_disparity);
  EXPECT_LE(measures.survival.bad_2, 0.10);
  EXPECT_LE(measures.difference.rmse, 0.050);
  EXPECT_NEAR(measures.left_gradient_energy / measures.right_gradient_energy, 1, 0.05);
}

}  // namespace wheatstone::quality_test
