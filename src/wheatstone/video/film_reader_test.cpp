#include "wheatstone/video/film_reader.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "psnr.h"
#include "scenes/moving_picture.h"
#include "shared_data.h"
#include "throws_error.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/guess_layout_internal.h"
#include "wheatstone/video/picture_conversion_internal.h"

namespace wheatstone::film_reader_test {

namespace fs = std::filesystem;

const FilmWriterOptions lossless{.codec = "ffv1"};

TEST(FilmReader, TellsAndDelivers) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 30, {.frame_rate = {25, 1}});
  FilmReader reader = open_film(folder / "a.mp4");
  const FilmFacts& facts = reader.facts();
  EXPECT_EQ(facts.container, "mp4");
  EXPECT_EQ(facts.codec, "h264");
  EXPECT_EQ(facts.width, 64);
  EXPECT_EQ(facts.height, 48);
  EXPECT_EQ(facts.frame_count, 30);
  EXPECT_EQ(facts.frame_rate, (Rational{25, 1}));
  EXPECT_NEAR(facts.duration_s, 1.2, 1e-9);
  EXPECT_EQ(facts.layout, StereoLayout::mono);
  EXPECT_TRUE(facts.side_streams.empty());
  const std::vector<Frame> frames = frames_of(std::move(reader));
  ASSERT_EQ(frames.size(), 30u);
  EXPECT_DOUBLE_EQ(frames[7].seconds(), 7 / 25.0);
  EXPECT_GT(psnr_db(frames[7].picture, moving_picture(64, 48, 7)), 36);
  EXPECT_LT(psnr_db(frames[7].picture, moving_picture(64, 48, 12)), 25);
}

TEST(FilmReader, APictureThatWasMovedAwayIsMadeAnew) {
  const TemporaryFolder folder;
  make_film(folder / "a.mkv", 3, lossless);
  FilmReader reader = open_film(folder / "a.mkv");
  std::vector<Image<Rgb8>> pictures;
  for (Frame frame; reader.read(frame);) pictures.push_back(std::move(frame.picture));
  ASSERT_EQ(pictures.size(), 3u);
  EXPECT_EQ(pictures[2], moving_picture(64, 48, 2));
}

TEST(FilmReader, FromToAndEvery) {
  const TemporaryFolder folder;
  make_film(folder / "a.mkv", 60, lossless);
  const auto numbers = [&](const FilmReaderOptions& options) {
    std::vector<int> found;
    for (const Frame& frame : frames_of(folder / "a.mkv", options)) {
      found.push_back(static_cast<int>(std::lround(frame.seconds() * 25)));
      EXPECT_EQ(frame.picture, moving_picture(64, 48, found.back()));
    }
    return found;
  };
  EXPECT_THAT(numbers({.from_s = 2.2}), testing::ElementsAre(55, 56, 57, 58, 59));
  EXPECT_THAT(numbers({.to_s = 0.12}), testing::ElementsAre(0, 1, 2));
  EXPECT_THAT(numbers({.from_s = 0.4, .to_s = 0.6}), testing::ElementsAre(10, 11, 12, 13, 14));
  EXPECT_THAT(numbers({.from_s = 1.0, .to_s = 1.4, .every = 4}), testing::ElementsAre(25, 29, 33));
  EXPECT_THAT(numbers({.from_s = 9}), testing::IsEmpty());
  expect_error(ErrorKind::wrong_usage, "every", [&] { open_film(folder / "a.mkv", {.every = 0}); });
  expect_error(ErrorKind::wrong_usage, "to", [&] { open_film(folder / "a.mkv", {.from_s = 3, .to_s = 3}); });
}

TEST(FilmReader, AnyBeginningFindsTheSameFramesInAFilmWithFewKeyFrames) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 60);
  const std::vector<Frame> all = frames_of(folder / "a.mp4");
  for (const int first : {1, 7, 31, 59}) {
    const std::vector<Frame> some = frames_of(folder / "a.mp4", {.from_s = first / 25.0});
    ASSERT_EQ(some.size(), 60u - first);
    EXPECT_EQ(some.front().picture, all[first].picture);
    EXPECT_EQ(some.front().pts, all[first].pts);
  }
}

TEST(FilmReader, SkippingIsReadingWithoutThePictures) {
  const TemporaryFolder folder;
  make_film(folder / "a.mkv", 20, lossless);
  FilmReader reader = open_film(folder / "a.mkv", {.every = 2});
  EXPECT_EQ(reader.skip(4), 4);
  Frame frame;
  ASSERT_TRUE(reader.read(frame));
  EXPECT_EQ(frame.picture, moving_picture(64, 48, 8));
  EXPECT_EQ(reader.skip(100), 5);
  EXPECT_FALSE(reader.read(frame));
}

TEST(FilmReader, ThreadsChangeNothing) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 40);
  const std::vector<Frame> one = frames_of(folder / "a.mp4", {.threads = 1});
  const std::vector<Frame> many = frames_of(folder / "a.mp4", {.threads = 7});
  ASSERT_EQ(one.size(), many.size());
  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].picture, many[i].picture);
}

TEST(FilmReader, AFilmOfOneFrame) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    make_film(folder / name, 1);
    EXPECT_EQ(frames_of(folder / name).size(), 1u) << name;
  }
}

TEST(FilmReader, EveryMatrixAndRangeComesBackAsTheSameColours) {
  const TemporaryFolder folder;
  const Image<Rgb8> colours = moving_picture(64, 48, 3);
  for (const char* matrix : {"bt709", "smpte170m", "bt2020nc", "smpte240m", "fcc"}) {
    for (const char* range : {"tv", "pc"}) {
      const FilmWriterOptions options{
          .codec = "ffv1", .pixel_format = "yuv444p", .colour = {.matrix = matrix, .range = range}};
      make_film(folder / "a.mkv", 4, options);
      FilmReader reader = open_film(folder / "a.mkv");
      EXPECT_EQ(reader.facts().colour.matrix, matrix);
      EXPECT_EQ(reader.facts().colour.range, range);
      Frame frame;
      reader.skip(3);
      ASSERT_TRUE(reader.read(frame));
      EXPECT_GT(psnr_db(frame.picture, colours), 45) << matrix << " " << range;
    }
  }
}

// The measure above can fail: red read with the wrong matrix is another red.
TEST(FilmReader, WrongTagsGiveWrongColours) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  make_film(folder / "a.mp4", 1, {.colour = {.matrix = "bt709"}});
  ffmpeg("-i " + (folder / "a.mp4").string() + " -c copy -bsf:v h264_metadata=matrix_coefficients=6 " +
         (folder / "b.mp4").string());
  EXPECT_GT(psnr_db(frames_of(folder / "a.mp4")[0].picture, moving_picture(64, 48, 0)), 36);
  EXPECT_LT(psnr_db(frames_of(folder / "b.mp4")[0].picture, moving_picture(64, 48, 0)), 32);
}

TEST(FilmReader, TurnsFramesUpright) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  make_film(folder / "a.mp4", 2);
  const Image<Rgb8> stored = frames_of(folder / "a.mp4")[0].picture;
  for (const int degrees : {90, 180, 270}) {
    // The program's option says how the picture is to be turned back, against the clock.
    ffmpeg("-i " + (folder / "a.mp4").string() + " -c copy -metadata:s:v rotate=" + std::to_string(degrees) + " " +
           (folder / "b.mp4").string());
    FilmReader reader = open_film(folder / "b.mp4");
    const FilmFacts facts = reader.facts();
    EXPECT_EQ(facts.width, degrees == 180 ? 64 : 48);
    const Image<Rgb8> upright = frames_of(std::move(reader))[0].picture;
    ffmpeg("-i " + (folder / "b.mp4").string() + " -frames:v 1 -c:v ffv1 -pix_fmt yuv420p " +
           (folder / "c.mkv").string());
    // Chroma lies elsewhere once it is turned: not the same bytes.
    EXPECT_GT(psnr_db(upright, frames_of(folder / "c.mkv")[0].picture), 33) << degrees;
    EXPECT_LT(psnr_db(upright, stored), 20);
    EXPECT_EQ(facts.rotation_degrees, 360 - degrees);
  }
}

TEST(Orientation, TurnsAndFlips) {
  Image<Rgb8> picture(3, 2);
  picture(2, 0) = {9, 0, 0};
  EXPECT_EQ(turned(picture, {0, 1, -1, 0})(1, 2).r, 9);   // a quarter turn clockwise: top right goes to bottom right
  EXPECT_EQ(turned(picture, {0, -1, 1, 0})(0, 0).r, 9);   // against the clock: to top left
  EXPECT_EQ(turned(picture, {-1, 0, 0, -1})(0, 1).r, 9);  // half a turn: to bottom left
  EXPECT_EQ(turned(picture, {-1, 0, 0, 1})(0, 0).r, 9);   // mirrored: to top left
  EXPECT_EQ((PictureTurn{0, 1, -1, 0}).degrees(), 90);
}

TEST(FilmReader, NumberedPictures) {
  const TemporaryFolder folder;
  for (int i = 7; i < 12; ++i) {
    char name[32];
    std::snprintf(name, sizeof name, "f_%04d.png", i);
    write_image(folder / name, moving_picture(20, 10, i));
  }
  write_image(folder / "f_13.png", Image<Rgb8>(3, 3));  // not of the pattern
  FilmReader reader = open_film(folder / "f_%04d.png", {.sequence_rate = {10, 1}});
  EXPECT_EQ(reader.facts().frame_count, 5);
  EXPECT_EQ(reader.facts().container, "sequence");
  const std::vector<Frame> frames = frames_of(std::move(reader));
  ASSERT_EQ(frames.size(), 5u);
  EXPECT_EQ(frames[2].picture, moving_picture(20, 10, 9));
  EXPECT_DOUBLE_EQ(frames[2].seconds(), 0.2);
  EXPECT_EQ(frames_of(folder / "f_%04d.png", {.from_s = 0.3, .sequence_rate = {10, 1}}).size(), 2u);
}

TEST(FilmReader, AHoleInTheNumbersIsRefusedByName) {
  const TemporaryFolder folder;
  for (const char* name : {"f_01.png", "f_02.png", "f_05.png"}) write_image(folder / name, Image<Rgb8>(4, 4));
  expect_error(ErrorKind::bad_input, "f_03.png is missing, the next there is f_05.png",
               [&] { open_film(folder / "f_%02d.png"); });
  expect_error(ErrorKind::bad_input, "0 files have such names", [&] { open_film(folder / "g_%02d.png"); });
  expect_error(ErrorKind::wrong_usage, "second number pattern", [&] { open_film(folder / "f_%02d_%d.png"); });
  expect_error(ErrorKind::wrong_usage, "percent sign", [&] { open_film(folder / "f_%s.png"); });
  write_image(folder / "f_03.png", Image<Rgb8>(4, 4));
  write_image(folder / "f_04.png", Image<Rgb8>(5, 4));
  expect_error(ErrorKind::bad_input, "f_04.png: 5x4 pixels, expected 4x4", [&] { frames_of(folder / "f_%02d.png"); });
}

TEST(FilmReader, RefusesWhatIsNoFilm) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::bad_input, "no such file", [&] { open_film(folder / "a.mp4"); });
  put_bytes(folder / "empty.mp4", "");
  expect_error(ErrorKind::bad_input, "is empty", [&] { open_film(folder / "empty.mp4"); });
  put_bytes(folder / "text.mp4", std::string(5000, 'x'));
  expect_error(ErrorKind::bad_input, "text.mp4: no film", [&] { open_film(folder / "text.mp4"); });
  put_bytes(folder / "list.m3u8", "#EXTM3U\n#EXT-X-VERSION:3\n#EXTINF:1,\n/etc/passwd\n#EXT-X-ENDLIST\n");
  expect_error(ErrorKind::bad_input, "no film", [&] { open_film(folder / "list.m3u8"); });
  expect_error(ErrorKind::bad_input, "is a folder", [&] { open_film(folder / "."); });
}

TEST(FilmReader, RefusesSoundWithoutPicturesAndUnknownCodecs) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  ffmpeg("-f lavfi -i sine=d=0.2 " + (folder / "a.mka").string());
  expect_error(ErrorKind::bad_input, "a.mka: has no moving pictures", [&] { open_film(folder / "a.mka"); });

  make_film(folder / "a.mkv", 3);
  std::string bytes = bytes_of(folder / "a.mkv");
  const std::size_t codec = bytes.find("V_MPEG4/ISO/AVC");
  ASSERT_NE(codec, std::string::npos);
  bytes.replace(codec, 15, "V_WHATEVER/XXXX");
  put_bytes(folder / "b.mkv", bytes);
  expect_error(ErrorKind::bad_input, "b.mkv: its video codec is", [&] { open_film(folder / "b.mkv"); });
}

TEST(FilmReader, RefusesPicturesThatChangeTheirSize) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  const auto film = [&](const std::string& name, const std::string& size) {
    ffmpeg("-f lavfi -i testsrc=d=0.2:s=" + size + " -c:v mpeg2video " + (folder / name).string());
  };
  film("a.m2v", "64x48");
  film("b.m2v", "32x32");
  put_bytes(folder / "c.m2v", bytes_of(folder / "a.m2v") + bytes_of(folder / "b.m2v"));
  FilmReader reader = open_film(folder / "c.m2v");
  Frame frame;
  // The decoder may keep the last picture before the change to itself.
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(reader.read(frame)) << i;
  expect_error(ErrorKind::bad_input, "change from 64x48 to 32x32 pixels", [&] {
    while (reader.read(frame)) {
    }
  });
}

TEST(FilmReader, DeliversWhatIsLeftOfATruncatedFilmAndSaysSo) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    make_film(folder / name, 100);
    const std::string whole = bytes_of(folder / name);
    put_bytes(folder / name, whole.substr(0, whole.size() * 3 / 5));
    FilmReader reader = open_film(folder / name);
    std::int64_t count = 0;
    for (Frame frame; reader.read(frame); ++count) {
    }
    EXPECT_GT(count, 20) << name;
    EXPECT_LT(count, 90) << name;
    ASSERT_TRUE(reader.loss().has_value()) << name;
    EXPECT_THAT(*reader.loss(), testing::HasSubstr("breaks off after")) << name;
    FilmReader passed = open_film(folder / name);
    passed.skip_rest();
    EXPECT_THAT(passed.loss().value_or("whole"), testing::HasSubstr("breaks off after")) << name;
    Frame none;
    EXPECT_FALSE(passed.read(none)) << name;
  }
}

TEST(FilmReader, ATruncatedFilmWithSoundIsNoticedToo) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  for (const char* name : {"a.mkv", "a.mp4"}) {
    const std::string film = (folder / name).string();
    ffmpeg("-f lavfi -i testsrc=d=3:s=64x48 -f lavfi -i sine=d=4 -c:v libx264 -c:a aac -movflags faststart " + film);
    FilmReader whole = open_film(folder / name);
    EXPECT_EQ(whole.skip(1000), 75);
    EXPECT_EQ(whole.loss(), std::nullopt) << name << " " << *whole.loss();
    FilmReader passed = open_film(folder / name);
    passed.skip_rest();
    EXPECT_EQ(passed.loss(), std::nullopt) << name << " " << *passed.loss();
    const std::string bytes = bytes_of(folder / name);
    put_bytes(folder / name, bytes.substr(0, bytes.size() / 2));
    FilmReader part = open_film(folder / name);
    EXPECT_LT(part.skip(1000), 75);
    EXPECT_TRUE(part.loss().has_value()) << name;
  }
}

TEST(FilmReader, AWholeFilmHasNoLoss) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv", "a.mov"}) {
    make_film(folder / name, 30);
    for (const FilmReaderOptions& options : {FilmReaderOptions{}, {.from_s = 0.5}, {.to_s = 0.5}, {.every = 7}}) {
      FilmReader reader = open_film(folder / name, options);
      reader.skip(1000);
      EXPECT_EQ(reader.loss(), std::nullopt) << name << " " << *reader.loss();
    }
    for (const int frames : {0, 1, 29, 30}) {
      FilmReader reader = open_film(folder / name);
      reader.skip(frames);
      reader.skip_rest();
      EXPECT_EQ(reader.loss(), std::nullopt) << name << " " << *reader.loss();
    }
  }
}

TEST(FilmReader, AFilmWithoutItsIndexIsRefused) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  make_film(folder / "a.mp4", 30);
  ffmpeg("-i " + (folder / "a.mp4").string() + " -c copy " + (folder / "b.mp4").string());  // its index is at the end
  const std::string whole = bytes_of(folder / "b.mp4");
  put_bytes(folder / "b.mp4", whole.substr(0, whole.size() / 2));
  expect_error(ErrorKind::bad_input, "b.mp4: no film, or a damaged one", [&] { open_film(folder / "b.mp4"); });
}

TEST(FilmReader, DamagedBytesNeverEndTheProgram) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv"}) {
    make_film(folder / name, 12);
    const std::string whole = bytes_of(folder / name);
    for (std::size_t seed = 1; seed < 40; ++seed) {
      std::string bytes = whole;
      for (std::size_t i = 0; i < 8; ++i) bytes[(seed * 7919 + i * 104729) % bytes.size()] ^= static_cast<char>(1 << i);
      put_bytes(folder / name, bytes);
      try {
        EXPECT_LE(frames_of(folder / name).size(), 30u);
      } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::bad_input) << error.what();
      }
    }
  }
}

#ifndef __SANITIZE_ADDRESS__
std::int64_t resident_pages() {
  std::int64_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident;
}

TEST(FilmReader, ALongFilmNeedsNoMoreMemoryThanAShortOne) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 2000, {.preset = "ultrafast"});
  FilmReader reader = open_film(folder / "a.mp4");
  Frame frame;
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(reader.read(frame));
  const std::int64_t before = resident_pages();
  int count = 100;
  while (reader.read(frame)) ++count;
  EXPECT_EQ(count, 2000);
  EXPECT_LT(static_cast<double>(resident_pages()), 1.05 * static_cast<double>(before));
}
#endif

TEST(FilmReader, RealFilms) {
  const fs::path data = shared_data() / "video";
  if (!fs::exists(data / "mary_sbs.mp4")) GTEST_SKIP() << data << " is not there";
  const auto guess = [](const fs::path& path) {
    std::vector<Image<Rgb8>> pictures;
    for (Frame& frame : frames_of(path, {.every = 40})) pictures.push_back(std::move(frame.picture));
    return guess_layout(pictures).layout;
  };
  EXPECT_EQ(guess(data / "mary_sbs.mp4"), StereoLayout::left_right);
  EXPECT_EQ(guess(data / "tokyo_walk_mono.mp4"), StereoLayout::mono);
  FilmReader reader = open_film(data / "mary_sbs.mp4");
  EXPECT_EQ(reader.facts().colour.matrix, "bt709");
  EXPECT_EQ(reader.skip(1000), 120);
  EXPECT_EQ(reader.loss(), std::nullopt);
}

TEST(FilmReader, AnimatedPicturesAreFilms) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  make_film(folder / "a.mkv", 6, {.codec = "ffv1"});
  const std::string source = " -i " + (folder / "a.mkv").string() + " ";
  ffmpeg(source + "-lavfi 'split[a][b];[a]palettegen[p];[b][p]paletteuse' " + (folder / "a.gif").string());
  ffmpeg(source + "-c:v libwebp_anim -lossless 1 " + (folder / "a.webp").string());
  for (const std::string name : {"a.gif", "a.webp"}) {
    SCOPED_TRACE(name);
    const std::vector<Frame> frames = frames_of(folder / name);
    ASSERT_EQ(frames.size(), 6u);
    for (int i = 0; i < 6; ++i) {
      EXPECT_NEAR(frames[i].seconds(), i * 0.04, 1e-9);
      // A GIF has 256 colours.
      EXPECT_GT(psnr_db(frames[i].picture, moving_picture(64, 48, i)), name == "a.gif" ? 25 : 60);
    }
    const FilmFacts facts = open_film(folder / name).facts();
    EXPECT_EQ(facts.width, 64);
    EXPECT_NEAR(facts.frame_rate.value(), 25, 0.01);
    EXPECT_EQ(frames_of(folder / name, {.from_s = 0.08, .to_s = 0.16}).size(), 2u);
  }
  const std::string whole = bytes_of(folder / "a.webp");
  put_bytes(folder / "cut.webp", whole.substr(0, 20));
  expect_error(ErrorKind::bad_input, "cut.webp: a damaged WebP", [&] { open_film(folder / "cut.webp"); });
}

/// Mean difference of the frames' luma, 0..255.
double difference(const std::vector<Frame>& a, const std::vector<Frame>& b) {
  const auto luma = [](Rgb8 c) { return 0.299 * c.r + 0.587 * c.g + 0.114 * c.b; };
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (std::size_t p = 0; p < a[i].picture.pixels().size(); ++p, ++count)
      sum += std::abs(luma(a[i].picture.pixels()[p]) - luma(b[i].picture.pixels()[p]));
  return sum / count;
}

TEST(FilmReader, InterlacedFramesAreDeinterlaced) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  const auto file = [&](const char* name) { return (folder / name).string(); };
  // Fifty moments a second: as frames, and as the fields of 25 frames.
  make_film(folder / "moments.mkv", 24, {.codec = "ffv1", .frame_rate = {50, 1}}, 96, 64);
  ffmpeg("-i " + file("moments.mkv") + " -vf setpts=N/50/TB,fps=50,framestep=2 -r 25 -c:v libx264 -crf 1 " +
         file("whole.mp4"));
  ffmpeg("-i " + file("moments.mkv") +
         " -vf setpts=N/50/TB,fps=50,format=yuv420p,tinterlace=interleave_top,fieldorder=tff -r 25 -c:v libx264 -crf 1 "
         "-flags +ildct+ilme -g 6 " +
         file("fields.mp4"));
  ffmpeg("-i " + file("fields.mp4") + " -vf setfield=prog -c:v ffv1 " + file("unmarked.mkv"));
  ffmpeg("-i " + file("fields.mp4") + " -vf bwdif=send_frame:auto:interlaced -c:v ffv1 " + file("peer.mkv"));
  const std::vector<Frame> peer = frames_of(folder / "peer.mkv");
  const std::vector<Frame> whole = frames_of(folder / "whole.mp4"), read = frames_of(folder / "fields.mp4"),
                           unmarked = frames_of(folder / "unmarked.mkv");
  ASSERT_EQ(read.size(), 12u);
  ASSERT_EQ(whole.size(), read.size());
  ASSERT_EQ(unmarked.size(), read.size());
  EXPECT_TRUE(open_film(folder / "fields.mp4").facts().interlaced);
  EXPECT_FALSE(open_film(folder / "whole.mp4").facts().interlaced);
  EXPECT_FALSE(open_film(folder / "unmarked.mkv").facts().interlaced);
  // The upper field shows the moment of the whole frame, the lower one the moment after it.
  EXPECT_LT(difference(read, whole), 0.4 * difference(unmarked, whole))
      << difference(read, whole) << ", " << difference(unmarked, whole);
  ASSERT_EQ(peer.size(), read.size());
  EXPECT_EQ(difference(read, peer), 0) << "as ffmpeg does it";
  for (std::size_t i = 0; i < read.size(); ++i) EXPECT_NEAR(read[i].seconds(), static_cast<double>(i) / 25, 1e-3);
  // From any time, and on any number of threads, the same frames.
  for (const int from : {1, 5, 6, 7}) {
    const std::vector<Frame> rest = frames_of(folder / "fields.mp4", {.from_s = from / 25., .threads = 3});
    ASSERT_EQ(rest.size(), read.size() - static_cast<std::size_t>(from));
    for (std::size_t i = 0; i < rest.size(); ++i)
      EXPECT_TRUE(rest[i].picture == read[i + static_cast<std::size_t>(from)].picture) << from << ", " << i;
  }
}

}  // namespace wheatstone::film_reader_test
