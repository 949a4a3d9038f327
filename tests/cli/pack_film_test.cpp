// Films in other stereo layouts: `wheatstone pack film`, and a film for each eye from `pack` and `rotoscope`.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "cli/run_program.h"
#include "scenes/moving_picture.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::pack_film_test {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Words = std::vector<std::string>;

constexpr int width = 64, height = 48, frame_count = 7;

StereoPair eyes(int frame) { return {moving_picture(width, height, frame), moving_picture(width, height, frame, 4)}; }

/// Lossless, so that pictures can be compared.
void put_film(const TemporaryFolder& folder, const std::string& name = "film.mkv") {
  FilmWriter writer(folder / name, {.codec = "ffv1", .layout = StereoLayout::left_right});
  for (int i = 0; i < frame_count; ++i)
    writer.write({put_together(eyes(i).left, eyes(i).right, StereoLayout::left_right), i, {1, 25}, 1});
  writer.finish();
}

nlohmann::json run_in(const TemporaryFolder& folder, Words words) {
  words.insert(words.begin() + 1, {"--quiet", "--json"});
  const ProgramResult result = run_program(words, {.folder = folder / ""});
  EXPECT_EQ(result.exit_code, 0) << result.errors;
  return nlohmann::json::parse(result.output, nullptr, false);
}

template <class Expected>
void expect_frames(const fs::path& film, Expected expected) {
  const std::vector<Frame> frames = frames_of(film);
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(frame_count)) << film;
  for (int i = 0; i < frame_count; ++i) {
    EXPECT_TRUE(frames[i].picture == expected(eyes(i))) << film << ", frame " << i;
    EXPECT_NEAR(frames[i].seconds(), i / 25., 1e-3);
  }
}

TEST(PackFilm, EveryLayoutHoldsTheSourcesPicturesAtTheirTimes) {
  const TemporaryFolder folder;
  put_film(folder);
  for (const StereoLayout layout : {StereoLayout::right_left, StereoLayout::left_right_half, StereoLayout::top_bottom,
                                    StereoLayout::even_odd_rows, StereoLayout::checkerboard}) {
    const std::string name(layout_name(layout));
    const auto facts = run_in(folder, {"pack", "film.mkv", "--to", name, "--codec", "ffv1", "-o", name + ".mkv"});
    EXPECT_EQ(facts["frames"], frame_count);
    expect_frames(folder / (name + ".mkv"),
                  [&](const StereoPair& pair) { return put_together(pair.left, pair.right, layout); });
    EXPECT_EQ(open_film(folder / (name + ".mkv")).facts().layout, layout);
  }
  run_in(folder, {"pack", "film.mkv", "--to", "anaglyph", "--codec", "ffv1", "-o", "a.mkv"});
  expect_frames(folder / "a.mkv", [](const StereoPair& pair) {
    return anaglyph({pair.left, pair.right}, anaglyph_kinds().front());
  });
  run_in(folder, {"pack", "film.mkv", "--to", "sbs", "--swap", "--codec", "ffv1", "-o", "s.mkv"});
  expect_frames(folder / "s.mkv",
                [](const StereoPair& pair) { return put_together(pair.right, pair.left, StereoLayout::left_right); });
}

TEST(PackFilm, AFilmForEachEyeAndBack) {
  const TemporaryFolder folder;
  put_film(folder);
  const auto facts = run_in(folder, {"pack", "film.mkv", "--to", "two-files", "--codec", "ffv1", "-o", "eye.mkv"});
  EXPECT_EQ(facts["output"], "eye_left.mkv");
  EXPECT_EQ(facts["right_output"], "eye_right.mkv");
  EXPECT_FALSE(fs::exists(folder / "eye.mkv"));
  expect_frames(folder / "eye_left.mkv", [](const StereoPair& pair) { return pair.left; });
  expect_frames(folder / "eye_right.mkv", [](const StereoPair& pair) { return pair.right; });
  run_in(folder, {"pack", "eye_left.mkv", "eye_right.mkv", "--to", "sbs", "--codec", "ffv1", "-o", "both.mkv"});
  expect_frames(folder / "both.mkv",
                [](const StereoPair& pair) { return put_together(pair.left, pair.right, StereoLayout::left_right); });
  run_in(folder, {"pack", "film.mkv", "--to", "two-files", "-o", "p_%02d.png"});
  EXPECT_TRUE(fs::exists(folder / "p_left_07.png"));
  EXPECT_TRUE(fs::exists(folder / "p_right_01.png"));
}

TEST(PackFilm, KeepsSoundChaptersAndTimecode) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  put_bytes(folder / "c.txt",
            ";FFMETADATA1\n[CHAPTER]\nTIMEBASE=1/1000\nSTART=0\nEND=400\ntitle=Beginning\n[CHAPTER]\n"
            "TIMEBASE=1/1000\nSTART=400\nEND=800\ntitle=End\n");
  const std::string source = folder / "a.mp4";
  ffmpeg("-f lavfi -i testsrc2=s=160x48:r=25:d=0.8 -f lavfi -i sine=d=0.8 -f lavfi -i sine=f=880:d=0.8 -i " +
         (folder / "c.txt").string() +
         " -map 0 -map 1 -map 2 -map_metadata 3 -map_chapters 3 -c:a aac -timecode 01:00:00:00 " + source);
  for (const char* to : {"anaglyph", "two-files"}) {
    run_in(folder, {"pack", "a.mp4", "--layout", "sbs", "--to", to, "-o", "o.mp4"});
    const fs::path made = folder / (std::string(to) == "anaglyph" ? "o.mp4" : "o_right.mp4");
    const std::string told = ffprobe(
        "-show_entries stream=codec_type,pix_fmt:chapter_tags=title:stream_tags=timecode -show_chapters -of compact " +
            made.string(),
        folder);
    EXPECT_THAT(told, HasSubstr("Beginning")) << to;
    EXPECT_THAT(told, HasSubstr("title=End")) << to;
    EXPECT_THAT(told, HasSubstr("timecode=01:00:00:00")) << to;
    EXPECT_EQ(open_film(made).facts().side_streams.size(), 2u) << to;
    EXPECT_THAT(told, HasSubstr(std::string(to) == "anaglyph" ? "pix_fmt=yuv444p" : "pix_fmt=yuv420p"));
  }
}

TEST(PackFilm, WhatDoesNotFitIsRefusedAndLeavesNothing) {
  const TemporaryFolder folder;
  put_film(folder);
  make_film(folder / "one.mkv", 3, {.codec = "ffv1"});
  const auto refused = [&](Words words, int code, const std::string& part) {
    words.insert(words.begin(), "pack");
    expect_refused(folder, words, code, part);
  };
  refused({"film.mkv", "-o", "o.mkv"}, 2, "--to: says how a film is to hold both eyes");
  refused({"film.mkv", "--to", "quilt", "-o", "o.mkv"}, 2, "--to: there is no layout 'quilt' of films");
  refused({"film.mkv", "--to", "mono", "-o", "o.mkv"}, 2, "--to: is 'mono', expected a layout with both eyes");
  refused({"film.mkv", "--to", "sbs", "--quality", "9", "-o", "o.mkv"}, 2, "--quality: has no effect on a film");
  refused({"film.mkv", "--to", "sbs", "-o", "o.png"}, 2, "o.png: films are written to .mp4");
  refused({"film.mkv", "--to", "sbs", "-o", "film.mkv"}, 2, "film.mkv");
  refused({"one.mkv", "--layout", "mono", "--to", "sbs", "-o", "o.mkv"}, 3, "one.mkv: has one eye, expected two");
  refused({"film.mkv", "--layout", "diagonal", "--to", "sbs", "-o", "o.mkv"}, 2, "--layout: there is no layout");
  put_bytes(folder / "not.mp4", "not a film");
  refused({"not.mp4", "--to", "sbs", "-o", "o.mkv"}, 3, "not.mp4");
  EXPECT_FALSE(fs::exists(folder / "o.mkv"));
}

TEST(RotoscopedEyes, AFilmForEachEyeShowsWhatOneFilmOfBothShows) {
  const TemporaryFolder folder;
  put_film(folder);
  const Words how{"--codec", "ffv1", "--depth-budget", "full", "--checkpoint", "3"};
  const auto paint = [&](const std::string& layout, const std::string& output) {
    Words words{"rotoscope", "film.mkv", "--output-layout", layout, "-o", output};
    words.insert(words.end(), how.begin(), how.end());
    return run_in(folder, words);
  };
  paint("left-right", "both.mkv");
  EXPECT_EQ(paint("two-files", "eye.mkv")["right_output"], "eye_right.mkv");
  const std::vector<Frame> both = frames_of(folder / "both.mkv"), left = frames_of(folder / "eye_left.mkv"),
                           right = frames_of(folder / "eye_right.mkv");
  ASSERT_EQ(both.size(), static_cast<std::size_t>(frame_count));
  ASSERT_EQ(left.size(), both.size());
  ASSERT_EQ(right.size(), both.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    const StereoPair pair = cut_apart(both[i].picture, StereoLayout::left_right, "both");
    EXPECT_TRUE(left[i].picture == pair.left) << i;
    EXPECT_TRUE(right[i].picture == pair.right) << i;
  }
  EXPECT_FALSE(fs::exists(folder / "eye_left.mkv.part"));
  EXPECT_FALSE(fs::exists(folder / "eye_right.mkv.part"));
  expect_refused(folder, {"rotoscope", "film.mkv", "--layout", "mono", "--output-layout", "two-files", "-o", "o.mkv"},
                 2, "--output-layout: is 'two-files', but the film has one eye");
}

/// Where in a film the picture flashes, and where its sound clicks, in seconds.
struct Clap {
  double flash_s = -1, click_s = -1;
};

Clap clap_of(const fs::path& film, const TemporaryFolder& folder) {
  Clap clap;
  for (const Frame& frame : frames_of(film)) {
    double light = 0;
    for (const Rgb8 pixel : frame.picture.pixels()) light += pixel.g;
    if (light / static_cast<double>(frame.picture.pixels().size()) > 128 && clap.flash_s < 0)
      clap.flash_s = frame.seconds();
  }
  constexpr int rate = 48000;
  ffmpeg("-i " + film.string() + " -map 0:a -af aresample=async=1:first_pts=0 -ac 1 -ar 48000 -f s16le " +
         (folder / "sound.raw").string());
  const std::string bytes = bytes_of(folder / "sound.raw");
  for (std::size_t i = 0; i + 1 < bytes.size() && clap.click_s < 0; i += 2) {
    const int level =
        static_cast<std::int16_t>(static_cast<unsigned char>(bytes[i]) | static_cast<unsigned char>(bytes[i + 1]) << 8);
    if (std::abs(level) > 8000) clap.click_s = static_cast<double>(i) / 2 / rate;
  }
  return clap;
}

// The picture flashes, and the sound clicks, in a later part than the first.
TEST(RotoscopedSound, AClapIsSeenWhenItIsHeardAfterPartsAreJoined) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  ffmpeg(
      "-f lavfi -i \"color=black:s=128x48:r=24:d=1.25,geq=lum='if(eq(N,19),235,40)':cb=128:cr=128\" "
      "-f lavfi -i \"aevalsrc='0.9*between(t,19/24,20/24)*sin(2*PI*1000*t)':s=48000:d=1.25\" "
      "-c:v libx264 -preset ultrafast -pix_fmt yuv420p -c:a aac -b:a 192k " +
      (folder / "clap.mp4").string());
  const Clap source = clap_of(folder / "clap.mp4", folder);
  ASSERT_NEAR(source.flash_s, 19 / 24., 1e-3);
  ASSERT_NEAR(source.click_s, 19 / 24., 0.01);
  for (const std::string output : {"o.mp4", "o.mov", "o.mkv"}) {
    run_in(folder,
           {"rotoscope", "clap.mp4", "--layout", "sbs", "--checkpoint", "4", "--preset", "ultrafast", "-o", output});
    const Clap painted = clap_of(folder / output, folder);
    // A Matroska film is shifted as a whole where its sound begins before the pictures.
    EXPECT_NEAR(painted.click_s - painted.flash_s, source.click_s - source.flash_s, 0.003) << output;
    EXPECT_NEAR(painted.flash_s, source.flash_s, 0.05) << output;
  }
}

}  // namespace wheatstone::pack_film_test
