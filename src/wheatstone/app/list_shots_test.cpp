#include "wheatstone/app/list_shots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "scenes/film_of_scenes.h"
#include "throws_error.h"
#include "wheatstone/pictures/read_image.h"

namespace wheatstone::list_shots_test {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Twelve frames at 25 a second; frames 5 to 8 are another shot.
void make_film_of_three_shots(const fs::path& path) { make_mono_film_of_scenes(path, 12, {5, 9}); }

TEST(ListShots, NamesEachShotAndShowsItsMiddleFrame) {
  const TemporaryFolder folder;
  make_film_of_three_shots(folder / "a.mkv");
  const std::vector<FoundShot> shots = list_shots({folder / "a.mkv", {}, StereoLayout::mono}, {}, folder / "cuts.toml");
  ASSERT_EQ(shots.size(), 3u);
  EXPECT_EQ(shots[1].begin, 5);
  EXPECT_EQ(shots[1].frames, 4);
  EXPECT_NEAR(shots[1].begin_s, 0.2, 1e-3);
  EXPECT_NEAR(shots[1].length_s, 0.16, 1e-3);
  const std::string text = bytes_of(folder / "cuts.toml");
  EXPECT_THAT(text, HasSubstr("[[shot]]  # 2: from 0:00.200 on, 4 frames, 0.160 s, cuts_002.jpg\nbegin = 6\n"));
  const Image<Rgb8> shown = read_image(folder / "cuts_002.jpg");
  const std::vector<Frame> frames = frames_of(folder / "a.mkv");
  const auto difference = [&](int frame) {
    double sum = 0;
    for (std::size_t i = 0; i < shown.pixels().size(); ++i)
      sum += std::abs(shown.pixels()[i].r - frames[static_cast<std::size_t>(frame)].picture.pixels()[i].r);
    return sum;
  };
  for (const int other : {4, 5, 6, 8, 9}) EXPECT_LT(difference(7), difference(other)) << other;
  EXPECT_TRUE(fs::exists(folder / "cuts_003.jpg"));
}

TEST(ListShots, BeginsAShotAfterADissolve) {
  const TemporaryFolder folder;
  const Image<Rgb8> first = eyes_of_scenes(0, {}).left;
  Image<Rgb8> second = first;
  std::ranges::reverse(second.pixels());
  FilmWriter writer(folder / "a.mkv", {.codec = "ffv1"});
  for (int i = 0; i < 36; ++i) {
    const double share = std::clamp((i - 11) / 13., 0., 1.);  // frames 12 to 23 are mixtures
    Frame frame{first, i, {1, 25}, 1};
    std::ranges::transform(first.pixels(), second.pixels(), frame.picture.pixels().begin(), [&](Rgb8 from, Rgb8 to) {
      const auto level = [&](std::uint8_t a, std::uint8_t b) {
        return static_cast<std::uint8_t>(std::lround(a + share * (b - a)));
      };
      return Rgb8{level(from.r, to.r), level(from.g, to.g), level(from.b, to.b)};
    });
    writer.write(frame);
  }
  writer.finish();
  const std::vector<FoundShot> shots = list_shots({folder / "a.mkv", {}, StereoLayout::mono}, {}, folder / "cuts.toml");
  ASSERT_EQ(shots.size(), 2u);
  EXPECT_EQ(shots[1].begin, 24);
  EXPECT_EQ(shots[1].mixed_before, 12);
  EXPECT_EQ(shots[0].frames, 24);
  EXPECT_EQ(shots[1].frames, 12);
  EXPECT_THAT(bytes_of(folder / "cuts.toml"),
              HasSubstr("[[shot]]  # 2: from 0:00.960 on, 12 frames, 0.480 s, cuts_002.jpg, after a dissolve of 12 "
                        "frames\nbegin = 25\n"));
}

TEST(ListShots, TellsHowFarItHasLooked) {
  const TemporaryFolder folder;
  make_film_of_three_shots(folder / "a.mkv");
  double farthest = 0;
  list_shots({folder / "a.mkv", {}, StereoLayout::mono}, {}, folder / "cuts.toml",
             [&](std::string_view step, double share) {
               if (step == "looking for cuts") farthest = std::max(farthest, share);
             });
  EXPECT_NEAR(farthest, 11. / 12, 0.01);
}

TEST(ListShots, RefusesToOverwriteWhatMayHaveBeenEdited) {
  const TemporaryFolder folder;
  make_film_of_three_shots(folder / "a.mkv");
  put_bytes(folder / "shots.toml", "[[shot]]\nbegin = 1\n");
  const FilmFiles film{folder / "a.mkv", {}, StereoLayout::mono};
  expect_error(ErrorKind::wrong_usage, "shots.toml: exists, and may have been edited",
               [&] { list_shots(film, {}, folder / "shots.toml"); });
  EXPECT_EQ(bytes_of(folder / "shots.toml"), "[[shot]]\nbegin = 1\n");
  EXPECT_FALSE(fs::exists(folder / "shots_001.jpg"));
  expect_error(ErrorKind::wrong_usage, "shots.txt: expected a name that ends in .toml",
               [&] { list_shots(film, {}, folder / "shots.txt"); });
}

TEST(ListShots, LeavesNothingWhenItIsStopped) {
  const TemporaryFolder folder;
  make_film_of_three_shots(folder / "a.mkv");
  const Progress stop = [](std::string_view step, double share) {
    if (step == "making thumbnails" && share > 0.5) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "interrupted", [&] {
    list_shots({folder / "a.mkv", {}, StereoLayout::mono}, {}, folder / "shots.toml", stop);
  });
  EXPECT_FALSE(fs::exists(folder / "shots.toml"));
  EXPECT_FALSE(fs::exists(folder / "shots_001.jpg"));
}

}  // namespace wheatstone::list_shots_test
