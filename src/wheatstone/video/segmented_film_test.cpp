#include "wheatstone/video/segmented_film.h"

#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>

#include "psnr.h"
#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/video/fingerprint_internal.h"
#include "wheatstone/video/work_folder.h"

namespace wheatstone::segmented_film_test {

namespace fs = std::filesystem;

constexpr int frame_count = 50;
const SegmentOptions by_eight{.frames_per_segment = 8};

/// A source with uneven times, read as a long job would read it.
class Source {
 public:
  Frame next() {
    Frame frame{moving_picture(64, 48, number_), pts_, {1, 90000}, std::int64_t{1501} * (1 + number_ % 3)};
    pts_ += frame.duration;
    ++number_;
    return frame;
  }
  void skip(std::int64_t frames) {
    while (frames-- > 0) next();
  }
  bool at_end() const { return number_ >= frame_count; }

 private:
  int number_ = 0;
  std::int64_t pts_ = 0;
};

/// Runs the job, `most` frames of it. Returns how many frames it had to make.
int run(const fs::path& path, const FilmWriterOptions& options, int most = 1000) {
  SegmentedFilm film(path, options, by_eight);
  Source source;
  source.skip(film.frames_done());
  int made = 0;
  for (; made < most && !source.at_end(); ++made) film.write(source.next());
  if (made < most) film.finish();
  return made;
}

TEST(SegmentedFilm, InterruptedAndResumedIsTheSameFilm) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    for (const char* codec : {"h264", "hevc", "ffv1"}) {
      if (codec == std::string("ffv1") && name == std::string("a.mp4")) continue;
      const FilmWriterOptions options{.codec = codec, .layout = StereoLayout::top_bottom};
      const std::string whole = std::string("whole_") + name;
      EXPECT_EQ(run(folder / whole, options), frame_count);
      int made = 0;
      for (const int killed_after : {1, 7, 13, 20, 3}) made += run(folder / name, options, killed_after);
      EXPECT_TRUE(fs::exists(work_folder_of(folder / name)));
      EXPECT_FALSE(fs::exists(folder / name));
      made += run(folder / name, options);
      EXPECT_LE(made, frame_count + 5 * 7) << "more than one interval was repeated";
      EXPECT_TRUE(bytes_of(folder / whole) == bytes_of(folder / name)) << name << " " << codec;
      EXPECT_FALSE(fs::exists(work_folder_of(folder / name)));

      const std::vector<Frame> undisturbed = frames_of(folder / whole), resumed = frames_of(folder / name);
      ASSERT_EQ(resumed.size(), static_cast<std::size_t>(frame_count));
      Source source;
      for (int i = 0; i < frame_count; ++i) {
        const Frame truth = source.next();
        EXPECT_EQ(resumed[i].picture, undisturbed[i].picture);
        EXPECT_GT(psnr_db(resumed[i].picture, truth.picture), 36) << name << " " << codec << " " << i;
        EXPECT_NEAR(resumed[i].seconds(), truth.seconds(), name == std::string("a.mp4") ? 1e-12 : 0.00051);
      }
      EXPECT_EQ(open_film(folder / name).facts().layout, StereoLayout::top_bottom);
      fs::remove(folder / name);
    }
  }
}

#ifndef __SANITIZE_THREAD__  // it cannot follow a process that is forked beside other threads
// Not by a destructor that tidies up, but by the signal that no one can catch.
TEST(SegmentedFilm, AKilledProcessLosesOneIntervalAtMost) {
  const TemporaryFolder folder;
  const FilmWriterOptions options{.preset = "ultrafast"};
  run(folder / "whole.mp4", options);
  for (const int killed_after : {2, 9, 16, 30, 49}) {
    const pid_t child = ::fork();
    if (child == 0) {
      SegmentedFilm film(folder / "a.mp4", options, by_eight);
      Source source;
      for (int i = 0; i < killed_after; ++i) film.write(source.next());
      ::kill(::getpid(), SIGKILL);
    }
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_TRUE(WIFSIGNALED(status));
    EXPECT_EQ(SegmentedFilm(folder / "a.mp4", options, by_eight).frames_done(), killed_after / 8 * 8);
    run(folder / "a.mp4", options);
    EXPECT_TRUE(bytes_of(folder / "whole.mp4") == bytes_of(folder / "a.mp4")) << killed_after;
  }
}
#endif

TEST(SegmentedFilm, KilledWhileItJoinsItJoinsAgain) {
  const TemporaryFolder folder;
  run(folder / "whole.mp4", {});
  {
    SegmentedFilm film(folder / "a.mp4", {}, by_eight);
    for (Source source; !source.at_end();) film.write(source.next());
    const Progress stop = [](std::string_view, double) { throw Error(ErrorKind::interrupted, "stop"); };
    expect_error(ErrorKind::interrupted, "stop", [&] { film.finish(stop); });
  }
  EXPECT_FALSE(fs::exists(folder / "a.mp4"));
  EXPECT_EQ(run(folder / "a.mp4", {}), 0);
  EXPECT_TRUE(bytes_of(folder / "whole.mp4") == bytes_of(folder / "a.mp4"));
}

TEST(SegmentedFilm, NumberedPicturesAreExact) {
  const TemporaryFolder folder;
  run(folder / "f_%03d.png", {}, 20);
  EXPECT_EQ(run(folder / "f_%03d.png", {}), frame_count - 16);
  const std::vector<Frame> frames = frames_of(folder / "f_%03d.png");
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(frame_count));
  for (int i = 0; i < frame_count; ++i) EXPECT_EQ(frames[i].picture, moving_picture(64, 48, i));
}

TEST(SegmentedFilm, OneFrameASegmentAndOneFrameInAll) {
  const TemporaryFolder folder;
  for (const int count : {1, 5}) {
    SegmentedFilm film(folder / "a.mp4", {}, {.frames_per_segment = 1});
    for (int i = 0; i < count; ++i) film.write(moving_frame(64, 48, i));
    film.finish();
    const std::vector<Frame> frames = frames_of(folder / "a.mp4");
    ASSERT_EQ(frames.size(), static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) EXPECT_GT(psnr_db(frames[i].picture, moving_picture(64, 48, i)), 36);
  }
}

TEST(SegmentedFilm, BringsTheSoundWhenItJoins) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  ffmpeg("-f lavfi -i testsrc=d=2:s=64x48 -f lavfi -i sine=d=2 -c:a aac " + (folder / "source.mp4").string());
  SegmentedFilm film(folder / "a.mp4", {.side_streams_from = folder / "source.mp4"}, by_eight);
  for (const Frame& frame : frames_of(folder / "source.mp4")) film.write(frame);
  film.finish();
  const FilmFacts facts = open_film(folder / "a.mp4").facts();
  ASSERT_EQ(facts.side_streams.size(), 1u);
  EXPECT_EQ(facts.frame_count, 50);
  EXPECT_TRUE(film.notes().empty());
}

TEST(SegmentedFilm, SoundThatTheContainerCannotTakeIsLeftOutAndNamed) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  make_film_with_undescribed_sound(folder / "source.ts");
  for (const std::string name : {"a.mp4", "a.mkv"}) {
    const FilmWriterOptions options{.side_streams_from = folder / "source.ts"};
    const std::vector<std::string> known_before = side_streams_left_out(folder / name, options);
    ASSERT_EQ(known_before.size(), 1u) << name;
    EXPECT_THAT(known_before[0], testing::HasSubstr("audio stream 1 (aac) of"));
    SegmentedFilm film(folder / name, options, by_eight);
    for (int i = 0; i < 10; ++i) film.write(moving_frame(64, 48, i));
    film.finish();
    EXPECT_THAT(film.notes(), testing::Contains(known_before[0]));
    EXPECT_EQ(open_film(folder / name).facts().frame_count.value_or(10), 10);
    EXPECT_TRUE(open_film(folder / name).facts().side_streams.empty());
  }
}

TEST(SegmentedFilm, SoundThatIsNotWantedIsNotCopied) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  put_bytes(folder / "words.srt", "1\n00:00:00,000 --> 00:00:01,000\nWords.\n");
  ffmpeg("-f lavfi -i testsrc=d=1:s=64x48 -f lavfi -i sine=d=1 -i " + (folder / "words.srt").string() +
         " -c:a aac -c:s srt " + (folder / "source.mkv").string());
  const auto kinds = [&](bool audio, bool subtitles) {
    FilmWriter writer(folder / "a.mkv",
                      {.side_streams_from = folder / "source.mkv", .copy_audio = audio, .copy_subtitles = subtitles});
    for (int i = 0; i < 5; ++i) writer.write(moving_frame(64, 48, i));
    writer.finish();
    EXPECT_TRUE(writer.notes().empty());
    std::string found;
    const FilmFacts facts = open_film(folder / "a.mkv").facts();
    for (const SideStream& stream : facts.side_streams) found += stream.kind + " ";
    return found;
  };
  EXPECT_EQ(kinds(true, true), "audio subtitles ");
  EXPECT_EQ(kinds(false, true), "subtitles ");
  EXPECT_EQ(kinds(true, false), "audio ");
}

TEST(SegmentedFilm, WhileNumberedPicturesAreJoinedAllLiesInItsFolder) {
  const TemporaryFolder folder;
  run(folder / "f_%03d.png", {}, 20);
  int steps = 0;
  SegmentedFilm film(folder / "f_%03d.png", {}, by_eight);
  film.write(moving_frame(64, 48, 16));
  const auto stop = [&](std::string_view, double) {
    for (const auto& entry : fs::directory_iterator(folder / "")) EXPECT_EQ(entry.path().filename(), "f_%03d.png.part");
    if (++steps == 2) throw Error(ErrorKind::interrupted, "interrupted");
  };
  expect_error(ErrorKind::interrupted, "interrupted", [&] { film.finish(stop); });
  EXPECT_EQ(steps, 2);
}

TEST(SegmentedFilm, KilledWhileNumberedPicturesGetTheirNamesItGoesOn) {
  const TemporaryFolder folder;
  run(folder / "f_%03d.png", {}, 20);
  put_bytes(folder / "f_001.png", "named already");
  expect_error(ErrorKind::wrong_usage, "f_001.png exists already", [&] { run(folder / "f_%03d.png", {}); });
  put_bytes(work_folder_of(folder / "f_%03d.png") / "naming", "");
  run(folder / "f_%03d.png", {});
  const std::vector<Frame> frames = frames_of(folder / "f_%03d.png");
  ASSERT_EQ(frames.size(), static_cast<std::size_t>(frame_count));
  EXPECT_EQ(frames[0].picture, moving_picture(64, 48, 0));
  EXPECT_FALSE(fs::exists(work_folder_of(folder / "f_%03d.png")));
}

TEST(SegmentedFilm, AnotherRunsFolderIsRefused) {
  const TemporaryFolder folder;
  run(folder / "a.mp4", {}, 10);
  const auto refused = [&](const FilmWriterOptions& options, const SegmentOptions& segments) {
    expect_error(ErrorKind::wrong_usage, "left by a run with other options",
                 [&] { SegmentedFilm(folder / "a.mp4", options, segments); });
  };
  refused({.crf = 30}, by_eight);
  refused({}, {.frames_per_segment = 9});
  refused({}, {.frames_per_segment = 8, .made_by = "another style"});
  put_bytes(folder / "source", "abc");
  refused({}, {.frames_per_segment = 8, .made_from = {folder / "source"}});
  EXPECT_EQ(SegmentedFilm(folder / "a.mp4", {}, by_eight).frames_done(), 8);
}

TEST(SegmentedFilm, TwoRunsDoNotWriteOneFilm) {
  const TemporaryFolder folder;
  const SegmentedFilm first(folder / "a.mp4", {}, by_eight);
  expect_error(ErrorKind::wrong_usage, "another run is painting it",
               [&] { SegmentedFilm(folder / "a.mp4", {}, by_eight); });
  // Not told to remove the folder of a run that is alive.
  expect_error(ErrorKind::wrong_usage, "another run is painting it",
               [&] { SegmentedFilm(folder / "a.mp4", {}, {.frames_per_segment = 8, .resume = false}); });
}

TEST(SegmentedFilm, ARestIsRefusedWhereItIsNotToBeGoneOnWith) {
  const TemporaryFolder folder;
  run(folder / "a.mp4", {}, 10);
  expect_error(ErrorKind::wrong_usage, "left by a run that did not finish",
               [&] { SegmentedFilm(folder / "a.mp4", {}, {.frames_per_segment = 8, .resume = false}); });
}

TEST(SegmentedFilm, AFolderInTheWayIsToldBeforeTheWork) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "a.mp4");
  expect_error(ErrorKind::cannot_read_write, "a.mp4: cannot write: is a folder",
               [&] { SegmentedFilm(folder / "a.mp4", {}, by_eight); });
  EXPECT_FALSE(fs::exists(work_folder_of(folder / "a.mp4")));
}

TEST(SegmentedFilm, ADamagedSegmentIsNamed) {
  const TemporaryFolder folder;
  run(folder / "a.mp4", {}, 20);
  const fs::path times = work_folder_of(folder / "a.mp4") / "seg_000001.json";
  const std::string whole = bytes_of(times);
  for (const std::string& bytes : {std::string("{"), std::string("{\"pts\": [3, 2]}"), std::string("[]")}) {
    put_bytes(times, bytes);
    expect_error(ErrorKind::bad_input, "seg_000001.json", [&] { run(folder / "a.mp4", {}); });
  }
  put_bytes(times, whole);
  put_bytes(work_folder_of(folder / "a.mp4") / "seg_000001.mkv", "no film");
  expect_error(ErrorKind::bad_input, "seg_000001.mkv", [&] { run(folder / "a.mp4", {}); });
}

TEST(SegmentedFilm, AFullDiskKeepsWhatIsDone) {
  const TemporaryFolder folder;
  run(folder / "whole.mp4", {});
  run(folder / "a.mp4", {}, 20);
  rlimit usual{};
  ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
  const auto usual_action = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit tight{.rlim_cur = 300, .rlim_max = usual.rlim_max};
  setrlimit(RLIMIT_FSIZE, &tight);
  expect_error(ErrorKind::cannot_read_write, "cannot write", [&] { run(folder / "a.mp4", {}); });
  setrlimit(RLIMIT_FSIZE, &usual);
  std::signal(SIGXFSZ, usual_action);
  EXPECT_EQ(run(folder / "a.mp4", {}), frame_count - 16);
  EXPECT_TRUE(bytes_of(folder / "whole.mp4") == bytes_of(folder / "a.mp4"));
}

TEST(Fingerprint, SeesAChangeAnywhereThatItSamples) {
  const TemporaryFolder folder;
  const auto print = [&](const std::string& bytes) {
    put_bytes(folder / "a", bytes);
    Fingerprint fingerprint;
    fingerprint.add_file(folder / "a");
    return fingerprint.text();
  };
  std::string bytes(300000, 'x');
  const std::string before = print(bytes);
  EXPECT_EQ(print(bytes), before);
  for (const std::size_t at : {std::size_t{0}, std::size_t{150000}, bytes.size() - 1}) {
    std::string changed = bytes;
    changed[at] = 'y';
    EXPECT_NE(print(changed), before) << at;
  }
  EXPECT_NE(print(bytes + "x"), before);
}

}  // namespace wheatstone::segmented_film_test
