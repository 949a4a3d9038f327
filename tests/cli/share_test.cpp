#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "cli/run_program.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone::share_test {

TEST(ShareCommand, RefusesASizeThatNoPageOfThePictureHas) {
  const TemporaryFolder folder;
  put_bytes(folder / "cloud.csv", "x,y,z\n0,0,0\n1,1,1\n2,1,0\n");
  const ProgramResult sliced = run_program(
      {"render", "cloud.csv", "--size", "64x48", "--save-slices", "s.exr", "-o", "views"}, {.folder = folder / ""});
  ASSERT_EQ(sliced.exit_code, 0) << sliced.errors;
  expect_refused(folder, {"share", "s.exr", "--max-size", "2kB", "-o", "page.html"}, 2,
                 "--max-size: is '2kB', but the smallest page of s.exr has ");
  const ProgramResult fits =
      run_program({"share", "s.exr", "--max-size", "200kB", "-o", "page.html"}, {.folder = folder / ""});
  EXPECT_EQ(fits.exit_code, 0) << fits.errors;
  EXPECT_LE(bytes_of(folder / "page.html").size(), 200'000u);
  const std::string long_caption(150'000, 'a');
  expect_refused(folder, {"share", "s.exr", "--max-size", "200kB", "--caption", long_caption, "-o", "more.html"}, 2,
                 "the smallest page");
}

TEST(ShareCommand, RefusesOneFileForTwoOutputs) {
  const TemporaryFolder folder;
  put_bytes(folder / "cloud.csv", "x,y,z\n0,0,0\n1,1,1\n2,1,0\n");
  std::filesystem::create_symlink("new.html", folder / "link.html");
  for (const char* other : {"new.html", "./new.html", "link.html"})
    expect_refused(folder, {"share", "cloud.csv", "-o", "new.html", "--element", other}, 2,
                   "is the same file as that of --output");
  expect_refused(folder, {"render", "cloud.csv", "-o", "v.exr", "--save-slices", "v.exr"}, 2,
                 "--save-slices: v.exr is the same file as that of --output");
  expect_refused(folder, {"rotoscope", "cloud.csv", "-o", "f_%04d.wst", "--save-marks", "f_%04d.wst"}, 2,
                 "--save-marks: f_%04d.wst is the same file as that of --output");
}

TEST(ShareCommand, SaysWhatIsMissingOfAFilm) {
  const TemporaryFolder folder;
  FilmWriterOptions options;
  options.layout = StereoLayout::left_right;
  std::mt19937 random(1);
  {
    FilmWriter writer(folder / "film.mkv", options);
    for (int i = 0; i < 40; ++i) {
      Image<Rgb8> frame(64, 32);
      for (Rgb8& pixel : frame.pixels()) pixel.r = static_cast<std::uint8_t>(random());
      writer.write({.picture = frame, .pts = i, .time_base = {1, 25}, .duration = 1});
    }
    writer.finish();
  }
  const std::string bytes = bytes_of(folder / "film.mkv");
  put_bytes(folder / "film.mkv", bytes.substr(0, bytes.size() / 2));
  const ProgramResult result = run_program({"share", "film.mkv", "-o", "page.html"}, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_NE(result.output.find("note: film.mkv: breaks off after"), std::string::npos) << result.output;
}

}  // namespace wheatstone::share_test
