// What `wheatstone rotoscope` cannot paint: one clear line, and nothing half-written.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/run_program.h"
#include "scenes/moving_picture.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::rotoscope_refusal_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Words = std::vector<std::string>;

void refused(const TemporaryFolder& folder, const Words& words, int exit_code, const std::string& part) {
  Words line{"rotoscope", "--quiet", "--preset", "ultrafast"};
  line.insert(line.end(), words.begin(), words.end());
  expect_refused(folder, line, exit_code, part);
}

TEST(RotoscopeRefusal, OfWhatIsNoFilm) {
  const TemporaryFolder folder;
  put_bytes(folder / "letter.mp4", "Dear Sir, this is a letter.\n");
  put_bytes(folder / "empty.mp4", "");
  fs::create_directory(folder / "empty");
  refused(folder, {"letter.mp4"}, 3, "letter.mp4: no film");
  refused(folder, {"empty.mp4"}, 3, "empty.mp4: is empty");
  refused(folder, {"missing.mp4"}, 3, "missing.mp4: no such file");
  refused(folder, {"empty"}, 3, "empty: has no numbered pictures");
  refused(folder, {"f_%04d.png"}, 3, "f_%04d.png: 0 files have such names, expected at least 1");
}

TEST(RotoscopeRefusal, OfAFilmWithoutPicturesOrOfAnUnknownCodec) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  ffmpeg("-f lavfi -i sine=d=0.3 -c:a aac " + (folder / "sound.mp4").string());
  refused(folder, {"sound.mp4"}, 3, "sound.mp4: has no moving pictures");
  make_film(folder / "unknown.mkv", 3, {.preset = "ultrafast"});
  std::string bytes = bytes_of(folder / "unknown.mkv");
  const std::size_t at = bytes.find("V_MPEG4/ISO/AVC");
  ASSERT_NE(at, std::string::npos);
  put_bytes(folder / "unknown.mkv", bytes.replace(at, 15, "V_PAINTED/STONE"));
  refused(folder, {"unknown.mkv"}, 3, "unknown.mkv: its video codec is unknown");
}

TEST(RotoscopeRefusal, OfATruncatedFilmComesAfterWhatDecodesIsWritten) {
  const TemporaryFolder folder;
  make_film(folder / "whole.mp4", 20, {.preset = "ultrafast"});
  const std::string bytes = bytes_of(folder / "whole.mp4");
  put_bytes(folder / "a.mp4", bytes.substr(0, bytes.size() * 2 / 3));
  const Words line{"rotoscope", "a.mp4", "--layout", "mono", "--quiet", "--preset", "ultrafast", "-o", "o.mp4"};
  const ProgramResult result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 3);
  EXPECT_THAT(result.errors, testing::StartsWith("wheatstone: a.mp4: breaks off after "));
  EXPECT_THAT(result.errors, HasSubstr("frames that could be decoded were painted to o.mp4\n"));
  EXPECT_EQ(std::count(result.errors.begin(), result.errors.end(), '\n'), 1);
  const std::size_t painted = frames_of(folder / "o.mp4").size();
  EXPECT_GT(painted, 5u);
  EXPECT_LT(painted, 20u);
  EXPECT_EQ(files_in(folder / ""), (std::set<std::string>{"whole.mp4", "a.mp4", "o.mp4"}));

  Words kept = line;
  kept.insert(kept.end(), {"--keep-going", "--json"});
  const ProgramResult going = run_program(kept, {.folder = folder / ""});
  EXPECT_EQ(going.exit_code, 0);
  EXPECT_EQ(going.errors, "");
  EXPECT_THAT(going.output, HasSubstr("\"loss\": \"a.mp4: breaks off"));
}

TEST(RotoscopeRefusal, OfSizesThatChange) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  for (const char* size : {"64x48", "96x48"})
    ffmpeg("-f lavfi -i testsrc2=r=25:d=0.4:s=" + std::string(size) + " -c:v libx264 -pix_fmt yuv420p " +
           (folder / size).string() + ".ts");
  put_bytes(folder / "a.ts", bytes_of(folder / "64x48.ts") + bytes_of(folder / "96x48.ts"));
  refused(folder, {"a.ts", "--layout", "mono", "--checkpoint", "4"}, 3, "change from 64x48 to 96x48 pixels");
  for (int i = 0; i < 3; ++i)
    write_image(folder / ("f_" + std::to_string(i) + ".png"), Image<Rgb8>(64, i < 2 ? 48 : 32));
  refused(folder, {"f_%d.png"}, 3, "f_2.png: 64x32 pixels, expected 64x48");
}

TEST(RotoscopeRefusal, OfEyesThatDoNotBelongTogether) {
  const TemporaryFolder folder;
  make_film(folder / "l.mp4", 6, {.preset = "ultrafast"});
  make_film(folder / "short.mp4", 5, {.preset = "ultrafast"});
  make_film(folder / "l.mkv", 6, {.preset = "ultrafast"});
  make_film(folder / "short.mkv", 5, {.preset = "ultrafast"});
  make_film(folder / "small.mp4", 6, {.preset = "ultrafast"}, 64, 32);
  refused(folder, {"l.mp4", "short.mp4"}, 3, "short.mp4: 5 frames, expected 6 like l.mp4");
  refused(folder, {"l.mkv", "short.mkv", "--checkpoint", "2"}, 3, "short.mkv: 5 frames, expected 6 like l.mkv");
  refused(folder, {"short.mkv,l.mkv"}, 3, "l.mkv: 6 frames, expected 5 like short.mkv");
  refused(folder, {"l.mp4", "small.mp4"}, 3, "small.mp4: 64x32 pixels, expected 64x48");
  make_film(folder / "odd.mkv", 2, {.codec = "ffv1"}, 81, 47);
  refused(folder, {"odd.mkv", "--layout", "sbs"}, 3, "81x47 pixels, expected an even width");
}

TEST(RotoscopeRefusal, OfASequenceWithAHole) {
  const TemporaryFolder folder;
  for (const int i : {1, 2, 4}) write_image(folder / ("f_" + std::to_string(i) + ".png"), Image<Rgb8>(64, 48));
  refused(folder, {"f_%d.png"}, 3, "f_3.png is missing, the next there is f_4.png");
}

TEST(RotoscopeRefusal, OfATruthThatIsNotThere) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "empty");
  for (int i = 1; i <= 2; ++i) write_image(folder / ("f_" + std::to_string(i) + ".png"), Image<Rgb8>(64, 48));
  refused(folder, {"f_%d.png,f_%d.png", "--truth", "empty"}, 3, "disparity_0000.pfm: cannot be opened");
  refused(folder, {"f_%d.png", "--truth", "empty", "--frame-step", "2"}, 2, "leave out --from and --frame-step");
}

TEST(RotoscopeRefusal, OfOptionsThatMakeNoSense) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 3, {.preset = "ultrafast"});
  const auto mono = [&](const Words& more, int exit_code, const std::string& part) {
    Words words{"a.mp4", "--layout", "mono"};
    words.insert(words.end(), more.begin(), more.end());
    refused(folder, words, exit_code, part);
  };
  refused(folder, {"a.mp4", "--layout", "sideways"}, 2, "--layout: there is no layout 'sideways'");
  mono({"--output-layout", "sbs"}, 2, "--output-layout: is 'sbs', but the film has one eye");
  mono({"--crf", "99"}, 2, "--crf: is '99', expected a number from 0 to 63");
  mono({"--codec", "mpeg9"}, 2, "--codec: is 'mpeg9', expected h264|hevc");
  mono({"--codec", "ffv1"}, 2, "expected .mkv");
  mono({"--pixel-format", "rgb"}, 2, "pixel format: rgb");
  mono({"--style", "cubist"}, 2, "cubist");
  mono({"--from", "soon"}, 2, "--from: is 'soon'");
  mono({"--from", "1", "--to", "0.5"}, 2, "to: 0.5 s, expected more than from");
  mono({"--from", "60"}, 2, "the film has no frame in the requested time range");
  mono({"--frame-step", "0"}, 2, "--frame-step");
  mono({"--every", "2"}, 2, "--every");
  mono({"--save-marks", "marks.wst"}, 2, "marks.wst: has no frame number pattern");
  mono({"-o", "o.avi"}, 2, "o.avi: films are written to");
  mono({"-o", "o_%04d.wst", "--resume"}, 2, "cannot be resumed");
}

TEST(RotoscopeRefusal, OfAnOutputThatWouldDestroySomething) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 3, {.preset = "ultrafast"});
  const std::string before = bytes_of(folder / "a.mp4");
  fs::create_symlink("a.mp4", folder / "link.mp4");
  for (const char* output : {"a.mp4", "./a.mp4", "link.mp4"})
    refused(folder, {"a.mp4", "--layout", "mono", "-o", output}, 2, "is the same file as the input");
  EXPECT_TRUE(bytes_of(folder / "a.mp4") == before);
  // Known before an hour of painting, not after it.
  write_image(folder / "o_0001.png", Image<Rgb8>(64, 48));
  refused(folder, {"a.mp4", "--layout", "mono", "-o", "o_%04d.png", "--checkpoint", "1"}, 2,
          "o_0001.png exists already");
  refused(folder, {"o_%04d.png", "-o", "o_%04d.png"}, 2, "o_0001.png exists already");
}

TEST(RotoscopeRefusal, OfPlacesWithoutRoomIsExitCodeFour) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 3, {.preset = "ultrafast"});
  refused(folder, {"a.mp4", "--layout", "mono", "-o", "a.mp4/o.mp4"}, 4, "a.mp4/o.mp4: cannot write");
  refused(folder, {"a.mp4", "--layout", "mono", "--save-marks", "a.mp4/m_%d.wst"}, 4, "a.mp4/m_%d.wst");
}

}  // namespace wheatstone::rotoscope_refusal_test
