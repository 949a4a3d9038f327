// Films that are painted only within masks, against scenes whose geometry is known.

#include "wheatstone/app/film_mask.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/film_of_scenes.h"
#include "thread_ranks.h"
#include "throws_error.h"
#include "wheatstone/app/film_plan.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/depth/convergence.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::film_mask_test {

namespace fs = std::filesystem;

Image<std::uint8_t> nearer_than(const Image<float>& disparity, float than) {
  Image<std::uint8_t> mask(disparity.width(), disparity.height());
  std::ranges::transform(disparity.pixels(), mask.pixels().begin(),
                         [than](float d) { return d > than ? std::uint8_t{255} : std::uint8_t{0}; });
  return mask;
}

/// A scene with its exact geometry, and the mask of all that is nearer than the middle of its depth.
struct MaskedScene {
  StereoPair eyes;
  KnownFrame known;
  Image<std::uint8_t> left, right;  ///< exact
};

MaskedScene make_masked_scene() {
  SyntheticFilmOptions options{.still = {.width = 240, .height = 160, .samples_a_side = 1}, .frames = 2};
  options.cut = 0;
  auto frame = make_synthetic_film_frame(options, 0);
  MaskedScene scene;
  scene.eyes = frame.pictures;
  scene.known.geometry = frame.geometry;
  const DepthEnds ends = depth_ends(frame.geometry.left_disparity);
  scene.left = nearer_than(frame.geometry.left_disparity, ends.middle_px());
  scene.right = nearer_than(frame.geometry.right_disparity, ends.middle_px());
  return scene;
}

double share_that_differs(const Image<std::uint8_t>& a, const Image<std::uint8_t>& b,
                          const Image<std::uint8_t>& left_out) {
  std::int64_t different = 0, all = 0;
  for (std::size_t i = 0; i < a.pixels().size(); ++i) {
    if (left_out.pixels()[i] != 0) continue;
    ++all;
    different += a.pixels()[i] != b.pixels()[i] ? 1 : 0;
  }
  return static_cast<double>(different) / static_cast<double>(all);
}

TEST(FilmMask, OfTheLeftEyeIsWhereTheRightEyeSeesTheSame) {
  const MaskedScene scene = make_masked_scene();
  const Image<std::uint8_t> moved = mask_in_right_eye(scene.left, scene.known.geometry.left_disparity);
  const Image<std::uint8_t> none(moved.width(), moved.height());
  // Pixels on outlines are rounded otherwise; what only the right eye sees belongs to what lies farther.
  EXPECT_LT(share_that_differs(moved, scene.right, none), 0.01);
  EXPECT_GT(share_that_differs(scene.left, scene.right, none), 0.05) << "the mask would be wrong if it stayed";
}

/// How many pixels of the picture are those of the source, within the mask and outside of it.
struct UntouchedShares {
  double inside = 0, outside = 0;
};
UntouchedShares untouched(const Image<Rgb8>& picture, const Image<Rgb8>& source, const Image<std::uint8_t>& mask) {
  double same_inside = 0, inside = 0, same_outside = 0, outside = 0;
  for (std::size_t i = 0; i < picture.pixels().size(); ++i) {
    const bool same = picture.pixels()[i] == source.pixels()[i];
    (mask.pixels()[i] != 0 ? inside : outside) += 1;
    (mask.pixels()[i] != 0 ? same_inside : same_outside) += same ? 1 : 0;
  }
  return {same_inside / inside, same_outside / outside};
}

TEST(FilmMask, TheFilmStaysAsItIsOutsideInBothEyes) {
  const MaskedScene scene = make_masked_scene();
  RotoscopeOptions options;
  RotoscopeState state;
  const FrameMask mask{scene.left, {}};
  const RotoscopedFrame frame = rotoscope_frame(scene.eyes, options, state, &scene.known, {}, &mask);
  const auto& eyes = std::get<StereoPair>(frame.pictures);
  const UntouchedShares left = untouched(eyes.left, scene.eyes.left, scene.left),
                        right = untouched(eyes.right, scene.eyes.right, scene.right);
  EXPECT_EQ(left.outside, 1);
  EXPECT_GT(right.outside, 0.99) << "all but outlines";
  EXPECT_LT(left.inside, 0.2);
  EXPECT_LT(right.inside, 0.2);
  // A mask of both eyes is exact in both.
  state = {};
  const FrameMask of_both{scene.left, scene.right};
  const RotoscopedFrame exact = rotoscope_frame(scene.eyes, options, state, &scene.known, {}, &of_both);
  EXPECT_EQ(untouched(std::get<StereoPair>(exact.pictures).right, scene.eyes.right, scene.right).outside, 1);
}

TEST(FilmMask, AnotherStyleIsPaintedOutsideAndGreyMixesBoth) {
  const MaskedScene scene = make_masked_scene();
  const auto painted = [&](const Style& style, const std::optional<Style>& outside, const FrameMask* mask) {
    RotoscopeOptions options;
    options.style = style;
    options.outside = outside;
    RotoscopeState state;
    return std::get<StereoPair>(rotoscope_frame(scene.eyes, options, state, &scene.known, {}, mask).pictures);
  };
  const Style oil = style_by_name("impressionist"), mosaic = style_by_name("mosaic");
  FrameMask mask{scene.left, scene.right};
  for (Image<std::uint8_t>* of_eye : {&mask.left, &mask.right})
    for (int x = 0; x < of_eye->width(); ++x) (*of_eye)(x, 3) = 51;  // a fifth
  const StereoPair both = painted(oil, mosaic, &mask), inside = painted(oil, {}, nullptr),
                   outside = painted(mosaic, {}, nullptr);
  for (int y = 0; y < mask.left.height(); ++y)
    for (int x = 0; x < mask.left.width(); ++x) {
      const int from = outside.right(x, y).g, to = inside.right(x, y).g, share = mask.right(x, y);
      ASSERT_EQ(both.right(x, y).g, (share * to + (255 - share) * from + 127) / 255) << x << ", " << y;
    }
}

class MaskedFilm : public testing::Test {
 protected:
  static constexpr int frames = 6;
  MaskedFilm() {
    make_film_of_scenes(file("film.mkv"), frames, {3, 6});
    for (int i = 0; i < frames; ++i) {
      Image<Rgb8> mask(96, 64);
      for (int y = 0; y < 64; ++y)
        for (int x = 10 * i; x < 10 * i + 40; ++x) mask(x, y) = {255, 255, 255};
      write_image(file(fmt::format("matte_{:04}.png", i + 1)), mask);
      write_image(file("still.png"), mask);
    }
  }
  fs::path file(const std::string& name) const { return folder_ / name; }
  StereoFilmReader source(const FilmReaderOptions& reading = {}) const {
    return open_stereo_film(file("film.mkv"), {}, reading);
  }
  FilmMask mask(const std::string& name, const FilmReaderOptions& reading = {}) const {
    const StereoFilmReader film = source(reading);
    return mask_of_film(file(name), {file("film.mkv"), film.facts(), reading}, film.layout());
  }
  RotoscopeFilmOptions usual() const {
    RotoscopeFilmOptions options;
    options.frames.style = style_by_name("impressionist");
    options.frames.outside = style_by_name("posterise");
    options.writing = {.preset = "ultrafast", .layout = StereoLayout::left_right};
    options.frames_between_checkpoints = 2;
    options.version = "1";
    return options;
  }
  void paint(const std::string& output, RotoscopeFilmOptions options, const Progress& progress = {}) const {
    StereoFilmReader film = source();
    options.mask = mask("matte_%04d.png");
    rotoscope_film(film, file(output), options, progress);
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(MaskedFilm, HasTheMaskOfEachFrameOrOneForAll) {
  const Image<Rgb8> left(96, 64);
  const FilmMask moving = mask("matte_%04d.png"), still = mask("still.png");
  EXPECT_EQ(moving(0, left).left(5, 5), 255);
  EXPECT_EQ(moving(2, left).left(5, 5), 0) << "a frame was left out";
  EXPECT_EQ(moving(2 + 1, left).left(35, 5), 255);
  EXPECT_TRUE(moving(4, left).right.empty());
  for (const int frame : {0, 4}) EXPECT_EQ(still(frame, left).left(55, 5), 255) << frame;
  const FilmMask later = mask("matte_%04d.png", {.from_s = 0.12});
  EXPECT_EQ(later(0, left).left(25, 5), 0);
  EXPECT_EQ(later(0 + 1, left).left(45, 5), 255);
}

TEST_F(MaskedFilm, HoldsBothEyesAsTheFramesOfTheFilm) {
  Image<Rgb8> both(192, 64);
  both(10, 7) = {255, 255, 255};
  both(96 + 12, 7) = {90, 90, 90};
  write_image(file("both.png"), both);
  const FrameMask of_frame = mask("both.png")(0, Image<Rgb8>(96, 64));
  EXPECT_EQ(of_frame.left(10, 7), 255);
  EXPECT_EQ(of_frame.right(12, 7), 90);
}

TEST_F(MaskedFilm, ThatDoesNotFitIsRefusedWithItsName) {
  write_image(file("small.png"), Image<Rgb8>(48, 32));
  expect_error(ErrorKind::bad_input,
               "small.png: is 48x32 pixels, expected 96x64 as an eye of " + file("film.mkv").string() +
                   ", or 192x64 for both eyes as its frames have them",
               [&] { mask("small.png")(0, Image<Rgb8>(96, 64)); });
  fs::remove(file("matte_0006.png"));
  expect_error(ErrorKind::bad_input, "matte_%04d.png: has 5 frames, expected as many as ",
               [&] { paint("a.mkv", usual()); });
  expect_error(ErrorKind::bad_input, "none.png", [&] { mask("none.png"); });
  EXPECT_FALSE(fs::exists(file("a.mkv")));
  RotoscopeState state;
  const FrameMask other{Image<std::uint8_t>(9, 9), {}};
  expect_error(ErrorKind::bad_input, "the mask is 9x9 pixels, expected 96x64 as the frame",
               [&] { plan_film_frame(eyes_of_scenes(0, {}), {}, state, nullptr, {}, &other); });
}

TEST_F(MaskedFilm, HasTheSameBytesByRanksAndByAPlanAndWhenItWasStopped) {
  for (const bool paints_outside : {false, true}) {
    RotoscopeFilmOptions options = usual();
    if (!paints_outside) options.frames.outside.reset();
    const std::string name = paints_outside ? "painted_" : "own_";
    paint(name + "whole.mkv", options);
    const std::string whole = bytes_of(file(name + "whole.mkv"));
    as_ranks(2, [&](const Ranks& ranks) {
      RotoscopeFilmOptions of_rank = options;
      of_rank.ranks = ranks;
      of_rank.scenes = {{0, 3}, frames};
      paint(name + "shared.mkv", of_rank);
    });
    EXPECT_TRUE(bytes_of(file(name + "shared.mkv")) == whole);
    RotoscopeFilmOptions planned = options;
    planned.plan = file(name + "plan");
    paint(name + "joined.mkv", planned);
    const FilmPlan plan = read_film_plan(planned.plan, options.version);
    draw_film_part(planned.plan, plan, {3, frames});
    draw_film_part(planned.plan, plan, {1, 2});
    join_film_parts(planned.plan, plan);
    EXPECT_TRUE(bytes_of(file(name + "joined.mkv")) == whole);
    const Progress stop = [](std::string_view step, double) {
      if (step.starts_with("painting frame 5")) throw Error(ErrorKind::interrupted, "interrupted");
    };
    RotoscopeFilmOptions again = options;
    expect_error(ErrorKind::interrupted, "the first 4 frames", [&] { paint(name + "stopped.mkv", again, stop); });
    again.resume = true;
    paint(name + "stopped.mkv", again);
    EXPECT_TRUE(bytes_of(file(name + "stopped.mkv")) == whole);
  }
}

}  // namespace wheatstone::film_mask_test
