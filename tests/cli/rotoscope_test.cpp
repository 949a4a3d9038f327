// What `wheatstone rotoscope` gives: times, sound, layouts, scenes, the same bytes, bounded memory.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "cli/run_program.h"
#include "psnr.h"
#include "scenes/moving_picture.h"
#include "shared_data.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/synthetic/synthetic_film.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone::rotoscope_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Words = std::vector<std::string>;

nlohmann::json rotoscope(const TemporaryFolder& folder, const Words& words) {
  Words line{"rotoscope", "--quiet", "--json", "--preset", "ultrafast"};
  line.insert(line.end(), words.begin(), words.end());
  const ProgramResult result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  EXPECT_EQ(result.errors, "");
  return nlohmann::json::parse(result.output, nullptr, false);
}

/// A film as `synth film` makes it, in the folder "film".
void make_synthetic(const TemporaryFolder& folder, int frames, int cut, const std::string& size = "160x96",
                    const std::string& noise = "0") {
  const ProgramResult result =
      run_program({"synth", "film", "-o", "film", "--size", size, "--frames", std::to_string(frames), "--cut",
                   std::to_string(cut), "--samples", "1", "--noise", noise, "--quiet"},
                  {.folder = folder / ""});
  ASSERT_EQ(result.exit_code, 0) << result.errors;
}

std::vector<StereoFrame> eyes_of(StereoFilmReader film) {
  std::vector<StereoFrame> frames;
  for (StereoFrame frame; film.read(frame);) frames.push_back(frame);
  return frames;
}

void expect_same_eyes(const std::vector<StereoFrame>& found, const std::vector<StereoFrame>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_TRUE(found[i].left == expected[i].left) << "left eye, frame " << i;
    EXPECT_TRUE(found[i].right == expected[i].right) << "right eye, frame " << i;
  }
}

/// The packets of a kind of stream, as sums.
std::string packets(const fs::path& film, const std::string& kind, const TemporaryFolder& folder) {
  ffmpeg("-i " + film.string() + " -map 0:" + kind + " -c copy -f framemd5 " + (folder / "sums.txt").string());
  std::ifstream sums(folder / "sums.txt");
  std::string all;
  for (std::string line; std::getline(sums, line);)
    if (!line.starts_with('#')) all += line + "\n";
  return all;
}

TEST(RotoscopeCommand, KeepsTimesSoundSubtitlesAndColours) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  put_bytes(folder / "s.srt", "1\n00:00:00,100 --> 00:00:00,300\nHello\n\n");
  const std::string source = folder / "a.mp4";
  ffmpeg("-f lavfi -i testsrc2=s=320x96:r=25:d=0.6 -f lavfi -i sine=d=0.7 -i " + (folder / "s.srt").string() +
         " -map 0 -map 1 -map 2 -vf \"select='not(eq(mod(n,5),2))'\" -vsync vfr -c:a aac -c:s mov_text "
         "-colorspace bt709 -color_primaries bt709 -color_trc bt709 -color_range tv -pix_fmt yuv420p " +
         source);
  const auto facts = rotoscope(folder, {"a.mp4", "--layout", "sbs", "-o", "o.mp4"});
  const std::vector<Frame> was = frames_of(source), is = frames_of(folder / "o.mp4");
  ASSERT_EQ(is.size(), was.size());
  EXPECT_EQ(facts["frames"], was.size());
  EXPECT_NE(was[1].duration, was[2].duration) << "the source's rate varies";
  for (std::size_t i = 0; i < was.size(); ++i) {
    EXPECT_DOUBLE_EQ(is[i].seconds(), was[i].seconds()) << i;
    EXPECT_EQ(is[i].duration, was[i].duration) << i;
    EXPECT_FALSE(is[i].picture == was[i].picture);
  }
  EXPECT_EQ(packets(folder / "o.mp4", "a", folder), packets(source, "a", folder));
  EXPECT_NE(packets(source, "a", folder), "");
  for (const char* name : {"a", "o"})
    ffmpeg("-i " + (folder / name).string() + ".mp4 -map 0:s " + (folder / name).string() + ".srt");
  EXPECT_EQ(bytes_of(folder / "o.srt"), bytes_of(folder / "a.srt"));
  EXPECT_THAT(bytes_of(folder / "o.srt"), HasSubstr("Hello"));
  const std::string probed = ffprobe(
      "-select_streams v -show_entries stream=color_range,color_space,color_transfer,color_primaries,nb_frames,duration"
      ":stream_side_data -of compact " +
          (folder / "o.mp4").string(),
      folder);
  EXPECT_THAT(probed, HasSubstr("color_range=tv|color_space=bt709|color_transfer=bt709|color_primaries=bt709"));
  EXPECT_THAT(probed, HasSubstr("type=side by side"));
  const auto length_s = [&](const std::string& film) {
    return std::stod(ffprobe("-select_streams v -show_entries stream=duration -of csv=p=0 " + film, folder));
  };
  EXPECT_NEAR(length_s(folder / "o.mp4"), length_s(source), 1e-6);
}

TEST(RotoscopeCommand, ARotatedSourceIsPaintedUpright) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  ffmpeg("-f lavfi -i testsrc2=s=160x96:r=25:d=0.12 -pix_fmt yuv420p " + (folder / "lying.mp4").string());
  ffmpeg("-i " + (folder / "lying.mp4").string() + " -c copy -metadata:s:v rotate=90 " + (folder / "a.mp4").string());
  rotoscope(folder, {"a.mp4", "--layout", "mono", "-o", "o.mp4"});
  const std::string probed =
      ffprobe("-show_entries stream=width,height:stream_side_data -of csv " + (folder / "o.mp4").string(), folder);
  EXPECT_THAT(probed, HasSubstr("96,160"));
  EXPECT_THAT(probed, testing::Not(HasSubstr("rotation")));
  const Image<Rgb8> painted = frames_of(folder / "o.mp4")[0].picture;
  const Image<Rgb8> upright = frames_of(folder / "a.mp4")[0].picture;
  Image<Rgb8> upside_down = upright;
  std::ranges::reverse(upside_down.pixels());
  EXPECT_GT(psnr_db(painted, upright), psnr_db(painted, upside_down) + 3);
}

TEST(RotoscopeCommand, PaintsThePartThatIsAskedFor) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 20, {.preset = "ultrafast"});
  const auto facts = rotoscope(
      folder, {"a.mp4", "--layout", "mono", "--from", "0.2", "--to", "0:0.6", "--frame-step", "2", "-o", "o.mp4"});
  EXPECT_EQ(facts["frames"], 5);
  const std::vector<Frame> frames = frames_of(folder / "o.mp4");
  ASSERT_EQ(frames.size(), 5u);
  for (int i = 0; i < 5; ++i) {
    EXPECT_NEAR(frames[i].seconds(), 0.08 * i, 1e-9);
    // Of the right frame: the next one looks less like it.
    EXPECT_GT(psnr_db(frames[i].picture, moving_picture(64, 48, 5 + 2 * i)),
              psnr_db(frames[i].picture, moving_picture(64, 48, 5 + 2 * i + 3)));
  }
}

TEST(RotoscopeCommand, TheSameEyesGiveTheSamePaintingInEveryLayout) {
  const TemporaryFolder folder;
  make_synthetic(folder, 2, 0, "96x64");
  const std::vector<StereoFrame> source =
      eyes_of(open_eye_films(folder / "film/left_%04d.png", folder / "film/right_%04d.png"));
  ASSERT_EQ(source.size(), 2u);
  const auto write = [&](const std::string& name, StereoLayout layout, auto picture_of) {
    FilmWriter writer(folder / name, {.codec = "ffv1", .layout = layout});
    for (int i = 0; i < 2; ++i) writer.write({picture_of(source[i]), i, {1, 25}, 1});
    writer.finish();
  };
  const auto both = [](StereoLayout layout) {
    return [layout](const StereoFrame& eyes) { return put_together(eyes.left, eyes.right, layout); };
  };
  write("sbs.mkv", StereoLayout::left_right, both(StereoLayout::left_right));
  write("tb.mkv", StereoLayout::top_bottom, both(StereoLayout::top_bottom));
  write("silent.mkv", StereoLayout::mono, both(StereoLayout::left_right));
  write("l.mkv", StereoLayout::mono, [](const StereoFrame& eyes) { return eyes.left; });
  write("r.mkv", StereoLayout::mono, [](const StereoFrame& eyes) { return eyes.right; });

  rotoscope(folder, {"film", "--codec", "ffv1", "-o", "o.mkv"});
  const std::vector<StereoFrame> expected = eyes_of(open_stereo_film(folder / "o.mkv"));
  ASSERT_EQ(expected.size(), 2u);
  struct Case {
    Words source;
    StereoLayout layout;
  };
  const std::vector<Case> cases{{{"sbs.mkv"}, StereoLayout::left_right},
                                {{"tb.mkv"}, StereoLayout::top_bottom},
                                {{"silent.mkv"}, StereoLayout::left_right},  // guessed
                                {{"silent.mkv", "--layout", "sbs"}, StereoLayout::left_right},
                                {{"l.mkv", "r.mkv"}, StereoLayout::left_right},
                                {{"l.mkv,r.mkv"}, StereoLayout::left_right},
                                {{"film/left_%04d.png,film/right_%04d.png"}, StereoLayout::left_right},
                                {{"sbs.mkv", "--output-layout", "tb"}, StereoLayout::top_bottom}};
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.source));
    Words words = c.source;
    words.insert(words.end(), {"--codec", "ffv1", "-o", "again.mkv"});
    rotoscope(folder, words);
    const StereoFilmReader film = open_stereo_film(folder / "again.mkv");
    EXPECT_EQ(film.layout(), c.layout);
    EXPECT_THAT(film.layout_how(), HasSubstr("container"));
    expect_same_eyes(eyes_of(open_stereo_film(folder / "again.mkv")), expected);
  }
  rotoscope(folder, {"sbs.mkv", "--output-layout", "anaglyph", "--codec", "ffv1", "-o", "glasses.mkv"});
  const std::vector<Frame> glasses = frames_of(open_film(folder / "glasses.mkv"));
  ASSERT_EQ(glasses.size(), expected.size());
  for (std::size_t i = 0; i < glasses.size(); ++i)
    EXPECT_EQ(glasses[i].picture, anaglyph({expected[i].left, expected[i].right})) << i;
  EXPECT_EQ(open_film(folder / "glasses.mkv").facts().layout, StereoLayout::mono);
  rotoscope(folder, {"film", "-o", "out_%04d.png"});
  expect_same_eyes(eyes_of(open_stereo_film(folder / "out_%04d.png", StereoLayout::left_right)), expected);
  EXPECT_TRUE(fs::exists(folder / "out_0001.png")) << "numbers from 1";
}

TEST(RotoscopeCommand, OneEyeGivesOneEye) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 3, {.preset = "ultrafast"});
  rotoscope(folder, {"a.mp4", "--layout", "mono", "-o", "o.mkv"});
  const FilmFacts facts = open_film(folder / "o.mkv").facts();
  EXPECT_EQ(facts.width, 64);
  EXPECT_EQ(facts.height, 48);
  const StereoFilmReader read = open_stereo_film(folder / "o.mkv");
  EXPECT_EQ(read.layout(), StereoLayout::mono);
}

TEST(RotoscopeCommand, NumberedPicturesHaveTheRateThatIsAskedFor) {
  const TemporaryFolder folder;
  make_film(folder / "f_%02d.png", 3);
  rotoscope(folder, {"f_%02d.png", "--rate", "30000/1001", "-o", "o.mp4"});
  EXPECT_NEAR(frames_of(folder / "o.mp4")[2].seconds(), 2 * 1001.0 / 30000, 1e-9);
  expect_refused(folder, {"rotoscope", "f_%02d.png", "--rate", "1/0", "--quiet"}, 2, "--rate: is '1/0'");
  expect_refused(folder, {"rotoscope", "o.mp4", "--layout", "mono", "--rate", "25", "--quiet"}, 2, "--rate");
}

TEST(RotoscopeCommand, NoStrokeCrossesACut) {
  const TemporaryFolder folder;
  make_synthetic(folder, 4, 2);
  EXPECT_EQ(rotoscope(folder, {"film", "-o", "o.mkv", "--codec", "ffv1"})["scenes"], 2);
  rotoscope(folder, {"film", "-o", "anew.mkv", "--codec", "ffv1", "--frame-by-frame"});
  const std::vector<StereoFrame> source =
      eyes_of(open_eye_films(folder / "film/left_%04d.png", folder / "film/right_%04d.png"));
  const std::vector<StereoFrame> carried = eyes_of(open_stereo_film(folder / "o.mkv"));
  const std::vector<StereoFrame> anew = eyes_of(open_stereo_film(folder / "anew.mkv"));
  // The first frame of the second scene looks like one that is painted alone, and not like the first scene.
  const double alone = psnr_db(anew[2].left, source[2].left);
  EXPECT_NEAR(psnr_db(carried[2].left, source[2].left), alone, 0.3);
  EXPECT_LT(psnr_db(carried[2].left, source[1].left), alone - 2);
}

TEST(RotoscopeCommand, SavesMarksAFrameEachFromOneOn) {
  const TemporaryFolder folder;
  make_synthetic(folder, 3, 0);
  fs::remove_all(folder / "marks");
  fs::create_directory(folder / "marks");
  rotoscope(folder, {"film", "-o", "o.mp4", "--save-marks", "marks/marks_%04d.wst"});
  EXPECT_THAT(files_in(folder / "marks"), testing::ElementsAre("marks_0001.wst", "marks_0002.wst", "marks_0003.wst"));
  const ProgramResult info = run_program({"info", "marks/marks_0003.wst"}, {.folder = folder / ""});
  EXPECT_EQ(info.exit_code, 0) << info.errors;
  EXPECT_THAT(info.output, HasSubstr("width: 160\nheight: 96\n"));
}

TEST(RotoscopeCommand, GivesTheSameBytesOnAnyNumberOfThreads) {
  const TemporaryFolder folder;
  make_synthetic(folder, 4, 2);
  rotoscope(folder, {"film", "-o", "one.mp4", "--threads", "1"});
  rotoscope(folder, {"film", "-o", "two.mp4", "--threads", "2"});
  EXPECT_TRUE(bytes_of(folder / "one.mp4") == bytes_of(folder / "two.mp4"));
  rotoscope(folder, {"film", "-o", "other.mp4", "--seed", "5"});
  EXPECT_FALSE(bytes_of(folder / "one.mp4") == bytes_of(folder / "other.mp4"));
}

TEST(RotoscopeCommand, FrameByFrameFlickersMore) {
  const TemporaryFolder folder;
  make_synthetic(folder, 5, 0, "160x96", "4");
  rotoscope(folder, {"film", "-o", "carried.mkv", "--codec", "ffv1"});
  rotoscope(folder, {"film", "-o", "anew.mkv", "--codec", "ffv1", "--frame-by-frame"});
  const ProgramResult measured = run_program(
      {"measure", "film", "carried.mkv", "anew.mkv", "--against", "film", "--truth", "film", "--json", "--quiet"},
      {.folder = folder / ""});
  ASSERT_EQ(measured.exit_code, 0) << measured.errors;
  const auto films = nlohmann::json::parse(measured.output)["films"];
  const double carried = films[0]["temporal_error"], anew = films[1]["temporal_error"];
  RecordProperty("carried_to_anew", std::to_string(carried / anew));
  EXPECT_LT(carried, 0.9 * anew);
}

TEST(RotoscopeCommand, OddSizesArePaddedWhereTheCodecMustAndSaidSo) {
  const TemporaryFolder folder;
  make_film(folder / "a.mkv", 2, {.codec = "ffv1"}, 81, 47);
  const auto padded = rotoscope(folder, {"a.mkv", "--layout", "mono", "-o", "o.mp4"});
  EXPECT_THAT(padded["notes"].dump(), HasSubstr("81x47 pixels become 82x48"));
  EXPECT_EQ(open_film(folder / "o.mp4").facts().width, 82);
  const auto exact = rotoscope(folder, {"a.mkv", "--layout", "mono", "-o", "o.mkv", "--codec", "ffv1"});
  EXPECT_EQ(exact["notes"].size(), 0u);
  EXPECT_EQ(open_film(folder / "o.mkv").facts().width, 81);
}

TEST(RotoscopeCommand, AFilmOfOneFrameIsPainted) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 1, {.preset = "ultrafast"});
  EXPECT_EQ(rotoscope(folder, {"a.mp4", "--layout", "mono", "-o", "o.mp4"})["frames"], 1);
  EXPECT_EQ(frames_of(folder / "o.mp4").size(), 1u);
}

// The address sanitizer keeps what was freed, and takes minutes for large pictures.
#ifndef __SANITIZE_ADDRESS__
TEST(RotoscopeCommandLong, MemoryDoesNotGrowWithTheFilm) {
  const TemporaryFolder folder;
  put_bytes(folder / "broad.toml", "radii = [24, 12]\n");
  const auto peak = [&](int frames) {
    FilmWriter writer(folder / "a.mp4", {.preset = "ultrafast"});
    // The same 24 frames over and over: more of them, and no others.
    for (int i = 0; i < frames; ++i) writer.write({moving_picture(320, 180, i % 24), i, {1, 25}, 1});
    writer.finish();
    const ProgramResult result =
        run_program({"rotoscope", "a.mp4", "--layout", "mono", "--style", "broad.toml", "--flow", "dis", "--checkpoint",
                     "12", "--threads", "2", "--preset", "ultrafast", "--quiet", "-o", "o.mp4"},
                    {.folder = folder / "", .own_process = true});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    return static_cast<double>(result.peak_bytes);
  };
  const double of_short = peak(24), of_long = peak(192);
  RecordProperty("short_MiB", std::to_string(of_short / (1 << 20)));
  RecordProperty("long_MiB", std::to_string(of_long / (1 << 20)));
  // A picture kept of every frame would be 168 x 320 x 180 x 3 bytes, a third of the short film's peak.
  EXPECT_LT(of_long, 1.12 * of_short);
}

TEST(RotoscopeCommandLong, PaintsRealFilms) {
  const fs::path films = shared_data() / "video";
  if (!fs::exists(films / "mary_sbs.mp4") || !fs::exists(films / "tokyo_walk_mono.mp4"))
    GTEST_SKIP() << "the real films are not there";
  const TemporaryFolder folder;
  for (const std::string name : {"mary_sbs.mp4", "tokyo_walk_mono.mp4"}) {
    const fs::path source = films / name;
    const FilmFacts facts = open_film(source).facts();
    const std::string to = std::to_string(1.5 / facts.frame_rate.value());
    const auto painted = rotoscope(folder, {source.string(), "--to", to, "-o", name});
    EXPECT_EQ(painted["frames"], 2) << name;
    EXPECT_EQ(open_film(folder / name).facts().width, facts.width);
    const StereoFilmReader read = open_stereo_film(folder / name);
    EXPECT_EQ(read.layout(), open_stereo_film(source).layout()) << name;
    EXPECT_EQ(frames_of(folder / name).size(), 2u);
  }
}
#endif

TEST(Rotoscope, SoundThatCannotBeCopiedIsNamedBeforeAndLeftOut) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  make_film_with_undescribed_sound(folder / "a.ts");
  const std::vector<std::string> line{"rotoscope", "a.ts", "--layout", "mono",     "--frame-step",
                                      "9",         "-o",   "o.mp4",    "--preset", "ultrafast"};
  const ProgramResult result = run_program(line, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.errors, testing::StartsWith("wheatstone: audio stream 1 (aac) of a.ts is left out: "));
  EXPECT_TRUE(open_film(folder / "o.mp4").facts().side_streams.empty());
  std::vector<std::string> silent = line;
  silent.insert(silent.end(), {"--no-audio", "-o", "p.mp4"});
  silent.erase(silent.begin() + 6, silent.begin() + 8);
  EXPECT_THAT(run_program(silent, {.folder = folder / ""}).errors, testing::Not(testing::HasSubstr("audio")));
}

}  // namespace wheatstone::rotoscope_test
