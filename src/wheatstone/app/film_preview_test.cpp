#include "wheatstone/app/film_preview.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "scenes/film_of_scenes.h"
#include "throws_error.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::film_preview_test {

namespace fs = std::filesystem;

constexpr int film_frames = 30;

class PreviewedFilm : public testing::Test {
 protected:
  PreviewedFilm() {
    // Shots of 12, 3 and 15 frames.
    FilmWriter writer(film_.film, {.preset = "ultrafast", .layout = StereoLayout::left_right});
    for (int i = 0; i < film_frames; ++i) {
      StereoPair eyes{moving_picture(192, 96, i), moving_picture(192, 96, i, 2)};
      if (i >= 12 && i < 15) {
        show_other_scene(eyes.left);
        show_other_scene(eyes.right);
      }
      writer.write({put_together(eyes.left, eyes.right, StereoLayout::left_right), i, {1, 25}, 1});
    }
    writer.finish();
    options_.writing = {.preset = "ultrafast", .layout = StereoLayout::left_right};
    options_.frames_between_checkpoints = 10;
    options_.shots = {{0, style_by_name("impressionist"), {}, {}},
                      {12, style_by_name("posterise"), {}, {}},
                      {15, style_by_name("impressionist"), {}, {}, {}, 4}};
  }
  FilmPreview preview(const std::string& sheet, const Progress& progress = {}) const {
    return preview_film(film_, folder_ / "painted.mkv", folder_ / sheet, options_, progress);
  }
  /// Of the film with these options, made once; the folder then has these files.
  struct Usual {
    FilmPreview told;
    std::set<std::string> files;
    Image<Rgb8> sheet;
  };
  const Usual& usual() const {
    static const Usual made = [this] {
      const FilmPreview told = preview("sheet.png");
      return Usual{told, files(), read_image(folder_ / "sheet.png")};
    }();
    return made;
  }
  std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_ / "")) names.insert(entry.path().filename().string());
    return names;
  }
  TemporaryFolder folder_;
  FilmFiles film_{folder_ / "film.mkv", {}, {}};
  RotoscopeFilmOptions options_;
};

TEST_F(PreviewedFilm, IsASheetWithARowAShotAndNoFilm) {
  const FilmPreview& made = usual().told;
  EXPECT_EQ(made.shots, 3);
  EXPECT_EQ(made.frames, film_frames);
  EXPECT_EQ(usual().files, (std::set<std::string>{"film.mkv", "sheet.png"}));
  // Tiles of 128×32 pixels: both eyes of a third of the size.
  const Image<Rgb8>& sheet = usual().sheet;
  EXPECT_EQ(sheet.width(), 5 * (128 + 12) + 12);
  EXPECT_EQ(sheet.height(), 3 * (32 + 26 + 12) + 12);
  const auto is_white = [&](int column, int row) {
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 128; ++x)
        if (sheet(12 + column * 140 + x, 12 + row * 70 + y) != Rgb8{255, 255, 255}) return false;
    return true;
  };
  for (int row = 0; row < 3; ++row)
    for (int column = 0; column < 5; ++column)
      EXPECT_EQ(is_white(column, row), row == 1 && column >= 3) << row << ", " << column << ": a shot has 3 frames";
}

TEST_F(PreviewedFilm, ShowsTheFramesOfTheFilmInTheStyleOfTheirShot) {
  const Image<Rgb8>& sheet = usual().sheet;
  // The third picture of the first shot is of the frame in its middle, and that of the last shot also.
  for (const auto& [row, number] : {std::pair{0, 6}, {2, 22}}) {
    const Image<Rgb8> whole = moving_picture(192, 96, number), other = moving_picture(192, 96, number + 12);
    double difference = 0, of_other = 0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 64; ++x) {
        const int shown = sheet(12 + 2 * 140 + x, 12 + row * 70 + y).g;
        difference += std::abs(shown - whole(3 * x + 1, 3 * y + 1).g);
        of_other += std::abs(shown - other(3 * x + 1, 3 * y + 1).g);
      }
    EXPECT_LT(difference / (32 * 64), 25) << row;
    EXPECT_LT(difference, of_other / 1.5) << row;
  }
}

TEST_F(PreviewedFilm, TellsAboutHowLongItTakesAndHowLargeItBecomes) {
  const FilmPreview& expected = usual().told;
  StereoFilmReader source = open_film(film_);
  const RotoscopedFilm made = rotoscope_film(source, folder_ / "painted.mkv", options_);
  const double bytes = static_cast<double>(fs::file_size(folder_ / "painted.mkv"));
  EXPECT_GT(expected.bytes, bytes / 2);
  EXPECT_LT(expected.bytes, bytes * 2);
  EXPECT_GT(expected.seconds, made.seconds / 4) << "other processes run at the same time";
  EXPECT_LT(expected.seconds, made.seconds * 4);
}

TEST_F(PreviewedFilm, OfNumberedPicturesTellsTheirSize) {
  options_.reading.to_s = 0.06;
  options_.shots.resize(1);
  for (const char* pattern : {"o_%04d.png", "o_%04d.exr"}) {
    const fs::path sheet = folder_ / (std::string(pattern).substr(7) + ".png");
    EXPECT_GT(preview_film(film_, folder_ / pattern, sheet, options_).bytes, 1000) << pattern;
    EXPECT_TRUE(fs::exists(sheet));
  }
}

TEST_F(PreviewedFilm, OfMasksDepthAndDisplaysIsMade) {
  Image<Rgb8> mask(192, 96);
  for (int x = 0; x < 60; ++x) mask(x, 50) = {255, 255, 255};
  write_image(folder_ / "mask.png", mask);
  const StereoFilmReader source = open_film(film_);
  options_.mask = mask_of_film(folder_ / "mask.png", {film_.film, source.facts(), {}}, StereoLayout::left_right);
  options_.frames.outside = style_by_name("mosaic");
  EXPECT_EQ(preview("masked.png").shots, 3);
  options_.mask = {};
  options_.frames.outside.reset();
  options_.frames.display = FilmDisplay{.views = {.views = 4, .width = 48, .height = 32}, .quilt = QuiltLayout{2, 2}};
  options_.writing.layout = StereoLayout::mono;
  EXPECT_EQ(preview("quilts.png").shots, 3);
  options_.known = [next = std::int64_t{0}](std::int64_t frame, const StereoPair& eyes) mutable {
    EXPECT_GE(frame, next) << "frames are asked for once, in their order";
    next = frame + 1;
    return KnownFrame{{}, {}, Image<float>(eyes.left.width(), eyes.left.height(), 1)};
  };
  film_.layout = StereoLayout::mono;
  EXPECT_EQ(preview("depth.png").shots, 3);
}

TEST_F(PreviewedFilm, LeavesNothingWhenItIsStoppedOrRefused) {
  expect_error(ErrorKind::wrong_usage, "sheet.mp4: expected the name of a picture", [&] { preview("sheet.mp4"); });
  const Progress stop = [](std::string_view, double share) {
    if (share > 0.5) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "interrupted", [&] { preview("sheet.png", stop); });
  EXPECT_EQ(files(), std::set<std::string>{"film.mkv"});
}

}  // namespace wheatstone::film_preview_test
