#include "wheatstone/video/stereo_film.h"

#include <gmock/gmock.h>

#include "psnr.h"
#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::stereo_film_test {

constexpr double eye_shift = 7;

void make_stereo_film(const std::filesystem::path& path, StereoLayout layout, bool say_it) {
  FilmWriter writer(path, {.codec = "ffv1", .layout = say_it ? layout : StereoLayout::mono});
  const LayoutTraits& traits = traits_of(layout);
  for (int i = 0; i < 12; ++i) {
    const Image<Rgb8> left = moving_picture(96, 54, i), right = moving_picture(96, 54, i, eye_shift);
    if (traits.arrangement == Arrangement::in_time) {
      writer.write({traits.right_first ? right : left, std::int64_t{2} * i, {1, 50}, 1});
      writer.write({traits.right_first ? left : right, 2 * i + 1, {1, 50}, 1});
    } else {
      writer.write({put_together(left, right, layout), i, {1, 25}, 1});
    }
  }
  writer.finish();
}

TEST(StereoFilm, EveryLayoutDeliversBothEyes) {
  const TemporaryFolder folder;
  for (const LayoutTraits& traits : stereo_layouts()) {
    make_stereo_film(folder / "a.mkv", traits.layout, true);
    StereoFilmReader reader = open_stereo_film(folder / "a.mkv", traits.layout);
    EXPECT_EQ(reader.layout_how(), "as asked");
    EXPECT_EQ(reader.skip(3), 3);
    StereoFrame eyes;
    int count = 3;
    for (; reader.read(eyes); ++count) {
      EXPECT_GT(psnr_db(eyes.left, moving_picture(96, 54, count)), traits.half ? 26 : 1000) << traits.name;
      EXPECT_NEAR(static_cast<double>(eyes.pts) * eyes.time_base.value(), count / 25.0, 1e-9) << traits.name;
      if (traits.layout == StereoLayout::mono) {
        EXPECT_TRUE(eyes.right.empty());
      } else {
        EXPECT_GT(psnr_db(eyes.right, moving_picture(96, 54, count, eye_shift)), traits.half ? 26 : 1000)
            << traits.name;
        EXPECT_LT(psnr_db(eyes.right, moving_picture(96, 54, count)), 22) << traits.name;
      }
    }
    EXPECT_EQ(count, 12) << traits.name;
  }
}

TEST(StereoFilm, OfAlternatingFilmsWholeMomentsAreChosen) {
  const TemporaryFolder folder;
  make_stereo_film(folder / "a.mkv", StereoLayout::alternating_right_first, true);
  // 0.1 s lies between the two frames of a moment.
  StereoFilmReader reader = open_stereo_film(folder / "a.mkv", {}, {.from_s = 0.1, .to_s = 0.36, .every = 2});
  EXPECT_EQ(reader.layout(), StereoLayout::alternating_right_first);
  StereoFrame eyes;
  for (const int number : {3, 5, 7}) {
    ASSERT_TRUE(reader.read(eyes));
    EXPECT_EQ(eyes.left, moving_picture(96, 54, number));
    EXPECT_EQ(eyes.right, moving_picture(96, 54, number, eye_shift));
  }
  EXPECT_FALSE(reader.read(eyes));
}

TEST(StereoFilm, KnowsTheLayoutFromTheFileOrGuessesIt) {
  const TemporaryFolder folder;
  make_stereo_film(folder / "said.mkv", StereoLayout::right_left, true);
  EXPECT_EQ(open_stereo_film(folder / "said.mkv").layout(), StereoLayout::right_left);
  EXPECT_EQ(open_stereo_film(folder / "said.mkv").layout_how(), "the container's stereo mode");
  make_stereo_film(folder / "unsaid.mkv", StereoLayout::top_bottom, false);
  const StereoFilmReader guessed = open_stereo_film(folder / "unsaid.mkv");
  EXPECT_EQ(guessed.layout(), StereoLayout::top_bottom);
  EXPECT_THAT(guessed.layout_how(), testing::HasSubstr("halves are alike"));
}

TEST(StereoFilm, AFilmAnEye) {
  const TemporaryFolder folder;
  make_film(folder / "l.mkv", 10, {.codec = "ffv1"});
  make_film(folder / "r_%02d.png", 10);
  StereoFilmReader reader = open_eye_films(folder / "l.mkv", folder / "r_%02d.png");
  StereoFrame eyes;
  for (int i = 0; i < 10; ++i) {
    ASSERT_TRUE(reader.read(eyes));
    EXPECT_EQ(eyes.left, moving_picture(64, 48, i));
    EXPECT_EQ(eyes.right, moving_picture(64, 48, i));
  }
  EXPECT_FALSE(reader.read(eyes));
  EXPECT_EQ(reader.loss(), std::nullopt);
}

TEST(StereoFilm, AnEyeThatMissesFramesIsRefusedWithBothCounts) {
  const TemporaryFolder folder;
  make_film(folder / "l.mp4", 10);
  make_film(folder / "r.mp4", 8);
  expect_error(ErrorKind::bad_input, "r.mp4: 8 frames, expected 10 like",
               [&] { open_eye_films(folder / "l.mp4", folder / "r.mp4"); });

  // Matroska does not say how many frames it has: that shows at the end.
  make_film(folder / "l.mkv", 8);
  make_film(folder / "r.mkv", 10);
  StereoFilmReader reader = open_eye_films(folder / "l.mkv", folder / "r.mkv");
  StereoFrame eyes;
  for (int i = 0; i < 8; ++i) ASSERT_TRUE(reader.read(eyes));
  expect_error(ErrorKind::bad_input, "r.mkv: 10 frames, expected 8 like", [&] { reader.read(eyes); });

  make_film(folder / "small.mp4", 10, {}, 32, 32);
  expect_error(ErrorKind::bad_input, "small.mp4: 32x32 pixels, expected 64x48",
               [&] { open_eye_films(folder / "l.mp4", folder / "small.mp4"); });
}

}  // namespace wheatstone::stereo_film_test
