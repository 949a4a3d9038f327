#include "wheatstone/app/rendered_film.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "scenes/rendered_frames.h"
#include "throws_error.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/matching/depth_fit.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::rendered_film_test {

namespace fs = std::filesystem;

constexpr int frames = 4;
constexpr DepthFit cameras{120, -3};

/// A frame of a walk along a table, made once.
const SyntheticFilmFrame& truth_of(int frame) {
  static std::map<int, SyntheticFilmFrame> made;
  const auto found = made.find(frame);
  if (found != made.end()) return found->second;
  return made[frame] = make_synthetic_film_frame(
             {.still = {.width = 240, .height = 136, .samples_a_side = 2}, .frames = 8, .cut = 0}, frame + 2);
}

Image<float> depth_of(const Image<float>& disparity) {
  Image<float> depth(disparity.width(), disparity.height());
  std::ranges::transform(disparity.pixels(), depth.pixels().begin(),
                         [](float px) { return static_cast<float>(cameras.scale / (px - cameras.offset_px)); });
  return depth;
}

Image<float> scaled(Image<float> image, float factor) {
  for (float& value : image.pixels()) value = std::isfinite(value) ? factor * value : 0;
  return image;
}

std::vector<RenderedView> views_of(int frame) {
  const SyntheticFilmFrame& truth = truth_of(frame);
  const std::array<Image<float>, 4> vectors{scaled(truth.to_previous.x, 1), scaled(truth.to_previous.y, -1),
                                            scaled(truth.to_next.x, -1), scaled(truth.to_next.y, 1)};
  return {{truth.pictures.left, depth_of(truth.geometry.left_disparity), vectors},
          {truth.pictures.right, depth_of(truth.geometry.right_disparity), vectors}};
}

class RenderedFilm : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = std::make_unique<TemporaryFolder>();
    // Blender counts from 1.
    for (int i = 0; i < frames; ++i)
      write_rendered_frame(file("f_000" + std::to_string(i + 1) + ".exr"), views_of(i), i == 0 ? "Z" : "V");
  }
  static void TearDownTestSuite() { folder_.reset(); }
  static fs::path file(const std::string& name) { return *folder_ / name; }
  static fs::path film() { return file("f_%04d.exr"); }

 private:
  static inline std::unique_ptr<TemporaryFolder> folder_;
};

/// Of the pixels where both are known.
double rms(const Image<float>& a, const Image<float>& b) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    const double off = a.pixels()[i] - b.pixels()[i];
    if (std::isfinite(off)) sum += off * off, ++count;
  }
  return std::sqrt(sum / std::max(count, 1.));
}

TEST_F(RenderedFilm, HasTheGeometryAndTheMotionThatWereRendered) {
  ASSERT_TRUE(is_rendered_film(film()));
  const KnownFrames known_of = known_of_rendered_film(film(), {});
  for (int i = 0; i < frames; ++i) {
    const SyntheticFilmFrame& truth = truth_of(i);
    const KnownFrame known = known_of(i, truth.pictures);
    EXPECT_LT(rms(known.geometry.left_disparity, truth.geometry.left_disparity), 0.1) << i;
    EXPECT_LT(rms(known.geometry.right_disparity, truth.geometry.right_disparity), 0.1) << i;
    ASSERT_EQ(known.flow.has_value(), i > 0);
    if (i == 0) continue;
    EXPECT_LT(rms(known.flow->backward.x, truth.to_previous.x), 1e-3) << i;
    EXPECT_LT(rms(known.flow->backward.y, truth.to_previous.y), 1e-3) << i;
    const SyntheticFilmFrame& before = truth_of(i - 1);
    EXPECT_LT(rms(known.flow->forward.x, before.to_next.x), 1e-3) << i;
    EXPECT_LT(rms(known.flow->forward.y, before.to_next.y), 1e-3) << i;
  }
  const KnownFrame again = known_of(1, truth_of(1).pictures);
  EXPECT_TRUE(again.flow);
  EXPECT_EQ(again.geometry.left_disparity,
            known_of_rendered_film(film(), {})(1, truth_of(1).pictures).geometry.left_disparity);
}

TEST_F(RenderedFilm, GivesTheFramesThatAreRead) {
  const KnownFrames later = known_of_rendered_film(film(), {.from_s = 2. / 24});
  const SyntheticFilmFrame& truth = truth_of(3);
  const KnownFrame known = later(1, truth.pictures);
  EXPECT_LT(rms(known.geometry.left_disparity, truth.geometry.left_disparity), 0.1);
  EXPECT_TRUE(known.flow);
  const KnownFrame every = known_of_rendered_film(film(), {.every = 3})(1, truth.pictures);
  EXPECT_LT(rms(every.geometry.left_disparity, truth.geometry.left_disparity), 0.1);
  EXPECT_FALSE(every.flow) << "the motion of one frame says nothing of three";
}

TEST_F(RenderedFilm, IsPaintedWithFewerStrokesThatEndThanByEstimates) {
  std::array<RotoscopeTotals, 2> totals;
  for (const bool exact : {false, true}) {
    StereoFilmReader source = open_stereo_film(film());
    RotoscopeFilmOptions options;
    options.writing = {.preset = "ultrafast", .layout = source.layout()};
    if (exact) options.known = known_of_rendered_film(film(), options.reading);
    totals[exact ? 1 : 0] = rotoscope_film(source, file(exact ? "exact.mkv" : "estimated.mkv"), options).totals;
  }
  const auto survival = [](const RotoscopeTotals& of) {
    return static_cast<double>(of.survived_strokes) / static_cast<double>(of.whole_strokes);
  };
  EXPECT_GT(survival(totals[1]), survival(totals[0]));
  EXPECT_LT(totals[1].worst_bare_share, 0.002);
}

TEST_F(RenderedFilm, OfADarkFrameHasTheCamerasOfTheOneBefore) {
  const TemporaryFolder folder;
  write_rendered_frame(folder / "d_1.exr", views_of(0));
  std::vector<RenderedView> dark = views_of(1);
  for (RenderedView& view : dark) view.picture = Image<Rgb8>(240, 136);
  write_rendered_frame(folder / "d_2.exr", dark);
  const KnownFrame known =
      known_of_rendered_film(folder / "d_%d.exr", {})(1, {dark.front().picture, dark.back().picture});
  EXPECT_LT(rms(known.geometry.left_disparity, truth_of(1).geometry.left_disparity), 0.1);
}

TEST_F(RenderedFilm, HasItsCutsWhateverTheMotionSays) {
  const TemporaryFolder folder;
  write_rendered_frame(folder / "c_1.exr", views_of(0));
  std::vector<RenderedView> other = views_of(1);
  for (RenderedView& view : other)
    for (Rgb8& pixel : view.picture.pixels())
      pixel = {static_cast<std::uint8_t>(255 - pixel.b), pixel.r, static_cast<std::uint8_t>(255 - pixel.g)};
  write_rendered_frame(folder / "c_2.exr", other);
  const StereoPair eyes{other.front().picture, other.back().picture};
  const KnownFrame known = known_of_rendered_film(folder / "c_%d.exr", {})(1, eyes);
  ASSERT_TRUE(known.flow);
  EXPECT_TRUE(std::ranges::all_of(known.flow->backward.x.pixels(), [](float px) { return std::isnan(px); }));
  EXPECT_FALSE(known_of_rendered_film(folder / "c_%d.exr", {}, false)(1, eyes).flow);
}

TEST_F(RenderedFilm, WithoutAnyDepthIsInfinitelyFar) {
  const TemporaryFolder folder;
  write_rendered_frame(folder / "z_1.exr", views_of(0));
  std::vector<RenderedView> black = views_of(1);
  for (RenderedView& view : black) {
    view.picture = Image<Rgb8>(240, 136);
    view.depth = Image<float>(240, 136);
  }
  write_rendered_frame(folder / "z_2.exr", black);
  const KnownFrame known =
      known_of_rendered_film(folder / "z_%d.exr", {})(1, {black.front().picture, black.back().picture});
  for (const float px : known.geometry.left_disparity.pixels()) ASSERT_NEAR(px, cameras.offset_px, 0.1);
  for (RenderedView& view : black) view.depth = {};
  write_rendered_frame(folder / "z_2.exr", black);
  expect_error(ErrorKind::bad_input, "z_2.exr: has no depth, expected it as in the first frame", [&] {
    known_of_rendered_film(folder / "z_%d.exr", {})(1, {black.front().picture, black.back().picture});
  });
}

TEST_F(RenderedFilm, WhoseDepthsContradictEachOtherIsRefused) {
  const TemporaryFolder folder;
  std::vector<RenderedView> views = views_of(0);
  for (float& depth : views.back().depth.pixels()) depth *= 3;
  write_rendered_frame(folder / "w_1.exr", views);
  expect_error(ErrorKind::bad_input, "w_1.exr: the depths of its views agree in",
               [&] { known_of_rendered_film(folder / "w_%d.exr", {})(0, truth_of(0).pictures); });
}

TEST_F(RenderedFilm, WhoseDepthSaysNothingOfItsEyesIsRefused) {
  const TemporaryFolder folder;
  std::vector<RenderedView> views = views_of(0);
  for (RenderedView& view : views)
    for (float& depth : view.depth.pixels()) depth = 1 / depth;
  write_rendered_frame(folder / "i_1.exr", views);
  expect_error(ErrorKind::bad_input, "i_1.exr: its depth does not tell where its eyes see things",
               [&] { known_of_rendered_film(folder / "i_%d.exr", {})(0, truth_of(0).pictures); });
  for (RenderedView& view : views) view.picture = Image<Rgb8>(240, 136);
  write_rendered_frame(folder / "i_1.exr", views);
  const KnownFrame dark =
      known_of_rendered_film(folder / "i_%d.exr", {})(0, {views.front().picture, views.back().picture});
  EXPECT_EQ(dark.geometry.left_disparity, Image<float>(240, 136)) << "nothing is seen yet";
}

TEST_F(RenderedFilm, IsNoneWithoutDepthOrAsOnePicture) {
  const TemporaryFolder folder;
  std::vector<RenderedView> views = views_of(0);
  for (RenderedView& view : views) view.depth = {};
  write_rendered_frame(folder / "n_1.exr", views);
  EXPECT_FALSE(is_rendered_film(folder / "n_%d.exr"));
  EXPECT_FALSE(is_rendered_film(folder / "n_1.exr"));
  EXPECT_EQ(read_multiview_exr(folder / "n_1.exr").size(), 2u);
  expect_error(ErrorKind::bad_input, "n_1.exr: has no channel Z", [&] { read_rendered_passes(folder / "n_1.exr"); });
}

}  // namespace wheatstone::rendered_film_test
