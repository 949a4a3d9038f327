#include "wheatstone/video/film_writer.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <malloc.h>
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <set>
#include <sstream>

#include "largest_difference.h"
#include "psnr.h"
#include "scenes/moving_picture.h"
#include "throws_error.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/frame_sequence.h"
#include "wheatstone/video/libav_internal.h"
#include "wheatstone/video/segmented_film.h"
#include "wheatstone/video/video_codings_internal.h"

namespace wheatstone::film_writer_test {

namespace fs = std::filesystem;

/// Times that no constant rate has.
std::vector<Frame> uneven_frames(Rational time_base, std::int64_t unit) {
  std::vector<Frame> frames;
  std::int64_t pts = 0;
  for (int i = 0; i < 40; ++i) {
    const std::int64_t duration = unit * (1 + (i * i) % 7);
    frames.push_back({moving_picture(64, 48, i), pts, time_base, duration});
    pts += duration;
  }
  return frames;
}

void write_film(const fs::path& path, const std::vector<Frame>& frames, const FilmWriterOptions& options = {}) {
  FilmWriter writer(path, options);
  for (const Frame& frame : frames) writer.write(frame);
  writer.finish();
}

struct SidePacket {
  std::string bytes;
  double seconds = 0;
};

std::vector<SidePacket> side_packets(const fs::path& path, AVMediaType type) {
  const OwnedInput input = open_input(path);
  const OwnedPacket packet = new_packet();
  std::vector<SidePacket> found;
  while (libav().av_read_frame(input.get(), packet.get()) >= 0) {
    const AVStream& stream = *input->streams[packet->stream_index];
    if (stream.codecpar->codec_type == type) {
      found.push_back({{reinterpret_cast<const char*>(packet->data), static_cast<std::size_t>(packet->size)},
                       static_cast<double>(packet->pts) * av_q2d(stream.time_base)});
    }
    libav().av_packet_unref(packet.get());
  }
  return found;
}

TEST(FilmWriter, Ffv1IsExact) {
  const TemporaryFolder folder;
  for (const int width : {64, 63}) {
    make_film(folder / "a.mkv", 10, {.codec = "ffv1"}, width, 47);
    const std::vector<Frame> frames = frames_of(folder / "a.mkv");
    ASSERT_EQ(frames.size(), 10u);
    for (int i = 0; i < 10; ++i) EXPECT_EQ(frames[i].picture, moving_picture(width, 47, i)) << i;
  }
}

/// Every code of ten bits, once in each row.
Frame ramp_of_ten_bits() {
  Frame frame{Image<Rgb8>(1024, 128), 0, {1, 25}, 1, Image<Rgb16>(1024, 128)};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 1024; ++x) {
      const auto code = static_cast<std::uint16_t>(std::lround(x * 65535. / 1023));
      const auto level = static_cast<std::uint8_t>((code + deep_level / 2) / deep_level);
      frame.deep(x, y) = {code, code, code};
      frame.picture(x, y) = {level, level, level};
    }
  return frame;
}

TEST(FilmWriter, TenBitsComeBackFromEveryCodecThatHasThem) {
  struct Case {
    const char* codec;
    const char* format;
    const char* name;
    int most_off;  ///< of 65535; a step of ten bits is 64
  };
  const TemporaryFolder folder;
  const Frame ramp = ramp_of_ten_bits();
  for (const auto& [codec, format, name, most_off] :
       {Case{"ffv1", "gbrp16le", "a.mkv", 0}, Case{"ffv1", "yuv444p10le", "a.mkv", 64},
        Case{"prores-4444", "", "a.mov", 64}, Case{"dnxhr", "", "a.mov", 128}, Case{"hevc-10", "", "a.mkv", 200}}) {
    for (const char* range : {"tv", "pc"}) {
      const FilmWriterOptions options{.codec = codec, .crf = {}, .pixel_format = format, .colour = {.range = range}};
      ASSERT_TRUE(writes_deep(folder / name, options)) << codec;
      write_film(folder / name, {ramp}, options);
      const std::vector<Frame> read = frames_of(folder / name, {.deep = true});
      ASSERT_TRUE(read.size() == 1 && same_size(read[0].deep, ramp.deep)) << codec << " " << format;
      int off = 0;
      for (std::size_t i = 0; i < ramp.deep.pixels().size(); ++i)
        off = std::max(off, std::abs(read[0].deep.pixels()[i].g - ramp.deep.pixels()[i].g));
      EXPECT_LE(off, most_off) << codec << " " << format << " " << range;
      // The same colours as in 8 bits, on the whole. From RGB of 16 bits, swscale rounds up.
      if (most_off == 0) continue;
      double deep = 0, level = 0;
      for (int x = 0; x < 1024; ++x)
        deep += read[0].deep(x, 64).g / static_cast<double>(deep_level), level += read[0].picture(x, 64).g;
      EXPECT_NEAR(deep / 1024, level / 1024, 0.15) << codec << " " << format << " " << range;
    }
  }
  // What other programs read: white is white.
  Frame white{Image<Rgb8>(64, 64, {255, 255, 255}), 0, {1, 25}, 1, Image<Rgb16>(64, 64, {65535, 65535, 65535})};
  write_film(folder / "w.mkv", {white}, {.codec = "ffv1", .pixel_format = "yuv444p10le"});
  write_film(folder / "v.mkv", {{white.picture, 0, {1, 25}, 1}}, {.codec = "ffv1", .pixel_format = "yuv444p10le"});
  EXPECT_EQ(frames_of(folder / "w.mkv")[0].picture, white.picture);
  EXPECT_EQ(frames_of(folder / "w.mkv", {.deep = true})[0].deep, frames_of(folder / "v.mkv", {.deep = true})[0].deep);
  make_film(folder / "b.mkv", 1, {.codec = "ffv1"});
  EXPECT_TRUE(frames_of(folder / "b.mkv", {.deep = true})[0].deep.empty());
  EXPECT_FALSE(writes_deep(folder / "b.mkv", {}));
  EXPECT_FALSE(writes_deep(folder / "b_%04d.png", {.codec = "hevc-10"}));
}

TEST(FilmWriter, OpenExrOfTwoEyesKeepsMoreThanEightBits) {
  const TemporaryFolder folder;
  Frame ramp = ramp_of_ten_bits();
  ramp.picture = put_together(ramp.picture, ramp.picture, StereoLayout::left_right);
  ramp.deep = put_together(ramp.deep, ramp.deep, StereoLayout::left_right);
  SegmentedFilm writer(folder / "a_%04d.exr", {.layout = StereoLayout::left_right}, {});
  writer.write(ramp);
  writer.finish();
  const std::vector<Frame> read = frames_of(folder / "a_%04d.exr", {.deep = true});
  ASSERT_TRUE(same_size(read[0].deep, ramp.deep));
  // Half floats have 11 bits of linear light: fewest in the lightest tones.
  for (std::size_t i = 0; i < ramp.deep.pixels().size(); ++i)
    ASSERT_NEAR(read[0].deep.pixels()[i].r, ramp.deep.pixels()[i].r, 16) << i;
  EXPECT_LE(largest_difference(read[0].picture, ramp.picture), 1);
}

TEST(FilmWriter, NumberedPicturesHaveTheBitsOfTheirSource) {
  const TemporaryFolder folder;
  const Frame ramp = ramp_of_ten_bits();
  Frame flat = ramp;
  flat.deep = {};
  FilmFacts source;
  for (const char* name : {"a_%d.png", "a_%d.tif"}) {
    for (const char* format : {"yuv420p10le", "yuv420p"}) {
      source.pixel_format = format;
      const bool is_deep = source.pixel_format == "yuv420p10le";
      FilmWriterOptions options;
      keep_bits(source, folder / name, options);
      EXPECT_EQ(writes_deep(folder / name, options), is_deep);
      SegmentedFilm writer(folder / name, options, {});
      // A frame of 8 bits comes first, as of a shot in a style of regions.
      writer.write(flat);
      Frame second = is_deep ? ramp : flat;
      second.pts = flat.pts + 1;
      writer.write(second);
      writer.finish();
      for (const int number : {1, 2}) {
        const fs::path file = frame_pattern(folder / name)->file(number);
        EXPECT_EQ(describe_image(file).bits, is_deep ? 16 : 8) << file;
        EXPECT_EQ(read_image(file), flat.picture) << file;
        EXPECT_TRUE(number == 1 || read_deep_image(file) == second.deep) << file;
        fs::remove(file);
      }
    }
  }
  SegmentedFilm writer(folder / "a_%d.exr", {}, {});
  writer.write(flat);
  writer.finish();
  EXPECT_EQ(read_image(folder / "a_1.exr"), flat.picture);
  FilmWriterOptions options;
  keep_bits(source, folder / "b_%d.webp", options);
  EXPECT_EQ(options.pixel_format, "");
}

TEST(FilmWriter, EveryCodecKeepsTheShapeOfPixelsAndTheRate) {
  const TemporaryFolder folder;
  for (const auto& [codec, name] : {std::pair{"prores-hq", "a.mov"},
                                    {"prores-hq", "a.mkv"},
                                    {"ffv1", "a.mkv"},
                                    {"h264", "a.mp4"},
                                    {"h264", "a.mkv"}}) {
    SegmentedFilm writer(folder / name, {.codec = codec, .frame_rate = {24, 1}, .pixel_aspect = {16, 15}}, {});
    for (int i = 0; i < 4; ++i) writer.write({moving_picture(64, 48, i), i, {1, 24}, 1});
    writer.finish();
    const FilmFacts facts = open_film(folder / name).facts();
    EXPECT_EQ(facts.pixel_aspect, (Rational{16, 15})) << codec << " " << name;
    EXPECT_NEAR(facts.frame_rate.value(), 24, 1e-3) << codec << " " << name;
    fs::remove(folder / name);
  }
}

TEST(FilmWriter, H264AndHevcAreClose) {
  const TemporaryFolder folder;
  for (const char* codec : {"h264", "hevc"}) {
    for (const char* format : {"yuv420p", "yuv444p"}) {
      make_film(folder / "a.mp4", 24, {.codec = codec, .pixel_format = format}, 320, 192);
      const std::vector<Frame> frames = frames_of(folder / "a.mp4");
      ASSERT_EQ(frames.size(), 24u);
      double worst = 1000;
      for (int i = 0; i < 24; ++i) worst = std::min(worst, psnr_db(frames[i].picture, moving_picture(320, 192, i)));
      EXPECT_GE(worst, 38) << codec << " " << format;
      RecordProperty(std::string(codec) + "_" + format + "_db", std::to_string(worst));
    }
  }
  // The measure can come out badly.
  make_film(folder / "a.mp4", 24, {.crf = 45}, 320, 192);
  EXPECT_LT(psnr_db(frames_of(folder / "a.mp4")[12].picture, moving_picture(320, 192, 12)), 34);
}

TEST(FilmWriter, EveryCodecIsReadBackFromEveryContainer) {
  const TemporaryFolder folder;
  for (const VideoCoding& coding : video_codings())
    for (const std::string_view ending : coding.containers) {
      const fs::path path = folder / fmt::format("a{}", ending);
      make_film(path, 6, {.codec = std::string(coding.name), .preset = "veryfast"}, 320, 192);
      const std::vector<Frame> frames = frames_of(path);
      ASSERT_EQ(frames.size(), 6u) << path << coding.name;
      for (int i = 0; i < 6; ++i)
        EXPECT_GE(psnr_db(frames[i].picture, moving_picture(320, 192, i)), 33) << path << coding.name;
      EXPECT_EQ(open_film(path).facts().pixel_format.ends_with("10le"),
                coding.formats.front().ends_with("10le") && coding.name != "prores-4444")
          << open_film(path).facts().pixel_format;  // ProRes 4444 is decoded with 12 bits
    }
}

TEST(FilmWriter, TenBitsKeepColoursThatEightBitsOfLumaAndChromaRound) {
  const TemporaryFolder folder;
  // Every step of a grey ramp, and of a coloured one.
  Frame ramp{Image<Rgb8>(256, 128), 0, {1, 25}, 1};
  for (int y = 0; y < 128; ++y)
    for (int x = 0; x < 256; ++x) {
      const auto step = static_cast<std::uint8_t>(x);
      ramp.picture(x, y) = y < 64 ? Rgb8{step, step, step} : Rgb8{step, static_cast<std::uint8_t>(255 - x), 90};
    }
  const auto colours_that_change = [&](const char* format) {
    write_film(folder / "a.mkv", {ramp}, {.codec = "av1", .crf = 0, .pixel_format = format});
    const Image<Rgb8> read = frames_of(folder / "a.mkv").front().picture;
    int changed = 0;
    for (int y = 0; y < 128; ++y)
      for (int x = 0; x < 256; ++x) changed += read(x, y) == ramp.picture(x, y) ? 0 : 1;
    return changed;
  };
  EXPECT_GT(colours_that_change("yuv444p"), 8000);
  EXPECT_LT(colours_that_change("yuv444p10le"), 300);
}

TEST(FilmWriter, ExrFilesHoldEachEyeAsAView) {
  const TemporaryFolder folder;
  const StereoPair eyes{moving_picture(64, 48, 0), moving_picture(64, 48, 3)};
  const Frame both{put_together(eyes.left, eyes.right, StereoLayout::left_right), 0, {1, 24}, 1};
  write_film(folder / "two_%04d.exr", {both}, {.layout = StereoLayout::left_right});
  EXPECT_EQ(read_multiview_exr(folder / "two_0001.exr"), (std::vector{eyes.left, eyes.right}));
  FilmReader two = open_film(folder / "two_%04d.exr");
  EXPECT_EQ(two.facts().layout, StereoLayout::left_right);
  Frame read;
  ASSERT_TRUE(two.read(read));
  EXPECT_EQ(read.picture, both.picture);

  write_film(folder / "one_%04d.exr", {both});
  EXPECT_FALSE(is_multiview_exr(folder / "one_0001.exr"));
  EXPECT_EQ(frames_of(folder / "one_%04d.exr").front().picture, both.picture);
}

TEST(FilmWriter, UnevenTimesSurvive) {
  const TemporaryFolder folder;
  struct Case {
    const char* name;
    Rational time_base;
    std::int64_t unit;
    const char* codec;
  };
  for (const Case& c : {Case{"a.mp4", {1, 90000}, 1501, "h264"}, Case{"a.mov", {1, 600}, 7, "h264"},
                        Case{"a.mp4", {1001, 30000}, 1, "hevc"}, Case{"a.mkv", {1, 1000}, 17, "h264"},
                        Case{"a.mkv", {1, 1000}, 17, "ffv1"}, Case{"a.mp4", {1, 1000}, 17, "h264"}}) {
    const std::vector<Frame> frames = uneven_frames(c.time_base, c.unit);
    write_film(folder / c.name, frames, {.codec = c.codec});
    const std::vector<Frame> once = frames_of(folder / c.name);
    ASSERT_EQ(once.size(), frames.size());
    write_film(folder / (std::string("again_") + c.name), once, {.codec = c.codec});
    const std::vector<Frame> twice = frames_of(folder / (std::string("again_") + c.name));
    ASSERT_EQ(twice.size(), frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      EXPECT_DOUBLE_EQ(once[i].seconds(), frames[i].seconds()) << c.name << " " << i;
      EXPECT_DOUBLE_EQ(twice[i].seconds(), frames[i].seconds()) << c.name << " " << i;
      EXPECT_NEAR(static_cast<double>(twice[i].duration) * twice[i].time_base.value(),
                  static_cast<double>(frames[i].duration) * c.time_base.value(), i + 1 < frames.size() ? 1e-12 : 1)
          << c.name << " " << i;
    }
  }
}

TEST(FilmWriter, MatroskaRoundsToMillisecondsAndSaysSo) {
  const TemporaryFolder folder;
  const std::vector<Frame> frames = uneven_frames({1, 90000}, 1501);
  FilmWriter writer(folder / "a.mkv");
  for (const Frame& frame : frames) writer.write(frame);
  writer.finish();
  EXPECT_THAT(writer.notes(), testing::ElementsAre(testing::HasSubstr("millisecond")));
  const std::vector<Frame> read = frames_of(folder / "a.mkv");
  for (std::size_t i = 0; i < frames.size(); ++i) EXPECT_NEAR(read[i].seconds(), frames[i].seconds(), 0.0005001);
}

TEST(FilmWriter, CopiesSoundAndSubtitlesBitForBit) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  put_bytes(folder / "s.srt", "1\n00:00:00,200 --> 00:00:00,900\nHello\n\n2\n00:00:01,200 --> 00:00:01,500\nagain\n\n");
  ffmpeg("-f lavfi -i testsrc=d=2:s=64x48 -f lavfi -i sine=d=2.3 -i " + (folder / "s.srt").string() +
         " -map 0 -map 1 -map 2 -c:a aac -c:s mov_text -metadata:s:a:0 language=fra " +
         (folder / "source.mp4").string());
  ffmpeg("-i " + (folder / "source.mp4").string() + " -map 0 -c copy -c:s srt " + (folder / "source.mkv").string());
  for (const char* source : {"source.mp4", "source.mkv"}) {
    for (const char* name : {"a.mp4", "a.mkv", "a.mov"}) {
      const std::string what = std::string(source) + " to " + name;
      const std::vector<Frame> frames = frames_of(folder / source);
      FilmWriter writer(folder / name, {.side_streams_from = folder / source});
      for (const Frame& frame : frames) writer.write(frame);
      writer.finish();
      const std::vector<SidePacket> was = side_packets(folder / source, AVMEDIA_TYPE_AUDIO);
      const std::vector<SidePacket> is = side_packets(folder / name, AVMEDIA_TYPE_AUDIO);
      ASSERT_EQ(is.size(), was.size()) << what;
      // Matroska cannot begin before zero: there all moves by an encoder's run-up, pictures too.
      const double moved = is.front().seconds - was.front().seconds;
      for (std::size_t i = 0; i < is.size(); ++i) {
        EXPECT_EQ(is[i].bytes, was[i].bytes) << what << " " << i;
        EXPECT_NEAR(is[i].seconds, was[i].seconds + moved, 0.0011) << what << " " << i;
      }
      const std::vector<Frame> pictures = frames_of(folder / name);
      ASSERT_EQ(pictures.size(), frames.size());
      EXPECT_NEAR(pictures[20].seconds(), frames[20].seconds() + moved, 0.0011) << what;
      const std::vector<SideStream> streams = open_film(folder / name).facts().side_streams;
      ASSERT_FALSE(streams.empty());
      EXPECT_EQ(streams[0].codec, "aac");
      EXPECT_EQ(streams[0].language, "fra");
      const bool fits = (source == std::string("source.mkv")) == (name == std::string("a.mkv"));
      EXPECT_EQ(streams.size(), fits ? 2u : 1u) << what;
      EXPECT_EQ(writer.notes().size(), fits ? 0u : 1u) << what;
      for (const std::string& note : writer.notes()) EXPECT_THAT(note, testing::HasSubstr("subtitle stream 2")) << what;
    }
  }
}

TEST(FilmWriter, KeepsChaptersTimecodeAndTheSphere) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  std::ofstream(folder / "chapters.txt") << ";FFMETADATA1\n[CHAPTER]\nTIMEBASE=1/1000\nSTART=0\nEND=800\ntitle=one\n"
                                            "[CHAPTER]\nTIMEBASE=1/1000\nSTART=800\nEND=2000\ntitle=two\n";
  const std::string source = (folder / "source.mov").string();
  ASSERT_EQ(std::system(fmt::format("ffmpeg -v error -f lavfi -i testsrc=s=64x48:r=25:d=2 -i {}/chapters.txt "
                                    "-map_metadata 1 -timecode 01:00:00:00 {}",
                                    (folder / ".").string(), source)
                            .c_str()),
            0);
  for (const char* name : {"a.mp4", "a.mov", "a.mkv"}) {
    FilmWriterOptions options{.frame_rate = {25, 1}, .projection = "360", .side_streams_from = source, .start_s = 1};
    FilmWriter writer(folder / name, options);
    for (int i = 25; i < 50; ++i) writer.write(moving_frame(64, 48, i));
    writer.finish();
    const OwnedInput read = open_input(folder / name);
    ASSERT_EQ(read->nb_chapters, 1u) << name;
    EXPECT_STREQ(libav().av_dict_get(read->chapters[0]->metadata, "title", nullptr, 0)->value, "two") << name;
    EXPECT_NEAR(static_cast<double>(read->chapters[0]->end) * av_q2d(read->chapters[0]->time_base), 1, 0.01) << name;
    const AVDictionaryEntry* timecode = libav().av_dict_get(read->streams[0]->metadata, "timecode", nullptr, 0);
    ASSERT_NE(timecode, nullptr) << name;
    EXPECT_STREQ(timecode->value, "01:00:01:00") << name;
    if (std::string(name) == "a.mov") continue;  // libav writes no sphere into QuickTime
    EXPECT_EQ(open_film(folder / name).facts().projection, "360") << name;
    // Kept by the next film, and changed or removed where that is asked for.
    for (const char* wanted : {"source", "180", "flat"}) {
      make_film(folder / "b.mkv", 3, {.projection = wanted, .side_streams_from = folder / name});
      EXPECT_EQ(open_film(folder / "b.mkv").facts().projection, std::string(wanted) == "source" ? "360" : wanted);
    }
  }
  expect_error(ErrorKind::wrong_usage, "projection: 270",
               [&] { make_film(folder / "c.mkv", 1, {.projection = "270"}); });
}

TEST(FilmWriter, APartOfAFilmBringsItsPartOfTheSound) {
  const TemporaryFolder folder;
  if (!has_program("ffmpeg")) GTEST_SKIP() << "the ffmpeg program is not installed";
  ffmpeg("-f lavfi -i testsrc=d=3:s=64x48 -f lavfi -i sine=d=3 -c:a pcm_s16le " + (folder / "source.mkv").string());
  const std::vector<Frame> frames = frames_of(folder / "source.mkv", {.from_s = 1, .to_s = 2});
  ASSERT_EQ(frames.size(), 25u);
  write_film(folder / "a.mov", frames, {.side_streams_from = folder / "source.mkv", .start_s = 1, .end_s = 2});
  const std::vector<SidePacket> sound = side_packets(folder / "a.mov", AVMEDIA_TYPE_AUDIO);
  std::size_t bytes = 0;
  for (const SidePacket& packet : sound) bytes += packet.bytes.size();
  EXPECT_NEAR(static_cast<double>(bytes), 44100 * 2, 44100 * 2 * 0.05);
  EXPECT_NEAR(sound.front().seconds, 0, 0.03);
  EXPECT_EQ(frames_of(folder / "a.mov").front().seconds(), 0);
}

/// What ffmpeg says of the first frame of each film; one start of the program, which takes longer than all films.
std::string first_frames_by_ffmpeg(const std::vector<fs::path>& films, const TemporaryFolder& folder) {
  std::string inputs, outputs;
  for (std::size_t i = 0; i < films.size(); ++i) {
    inputs += " -i " + films[i].string();
    outputs += " -map " + std::to_string(i) + ":v -frames:v 1 -vf showinfo -f null -";
  }
  const std::string command = "ffmpeg -nostdin -nostats" + inputs + outputs + " 2>" + (folder / "frames.txt").string();
  EXPECT_EQ(std::system(command.c_str()), 0) << command;  // NOLINT(bugprone-command-processor)
  return bytes_of(folder / "frames.txt");
}

TEST(FilmWriter, LayoutsComeBackAndAreShownToOthers) {
  const TemporaryFolder folder;
  std::vector<fs::path> said;
  for (const LayoutTraits& traits : stereo_layouts()) {
    for (const char* ending : {".mkv", ".mp4", ".mov"}) {
      const std::string name = std::string(traits.name) + ending;
      FilmWriter writer(folder / name, {.layout = traits.layout});
      for (int i = 0; i < 3; ++i) writer.write(moving_frame(64, 48, i));
      writer.finish();
      const FilmFacts facts = open_film(folder / name).facts();
      const bool unsaid = !writer.notes().empty();
      EXPECT_EQ(facts.layout, unsaid ? StereoLayout::mono : traits.layout) << name;
      // Matroska can say all; the others cannot say that the right eye comes first.
      EXPECT_EQ(unsaid, ending != std::string(".mkv") && traits.right_first) << name;
      if (!unsaid && traits.layout != StereoLayout::mono) said.push_back(folder / name);
    }
  }
  if (!has_program("ffmpeg")) return;
  const std::string shown = first_frames_by_ffmpeg(said, folder);
  // "[Parsed_showinfo_0 @ 0x55b3afe180c0]   side data - stereoscopic information: ...", a number for each film.
  std::set<std::string> films;
  std::istringstream lines(shown);
  for (std::string line; std::getline(lines, line);)
    if (line.find("stereoscopic information: type - ") != std::string::npos)
      films.insert(line.substr(0, line.find(']')));
  EXPECT_EQ(films.size(), said.size()) << shown;
}

// libx265 leaves decoding times of films of one and two frames to what its memory holds.
TEST(FilmWriter, HevcOfAFewFramesIsWrittenWhateverMemoryHolds) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mkv", "a.mp4"})
    for (const int byte : {0x02, 0xfd})  // numbers far above zero, and far below
      for (int count = 1; count <= 3; ++count) {
        SCOPED_TRACE(fmt::format("{} frames, {}", count, name));
        mallopt(M_PERTURB, byte);
        make_film(folder / name, count, {.codec = "hevc"}, 320, 192);
        mallopt(M_PERTURB, 0);
        const std::vector<Frame> read = frames_of(folder / name);
        ASSERT_EQ(read.size(), static_cast<std::size_t>(count));
        for (int i = 0; i < count; ++i) EXPECT_GT(psnr_db(read[i].picture, moving_picture(320, 192, i)), 30) << i;
        EXPECT_EQ(read.front().seconds(), 0);
        EXPECT_LT(read.back().seconds(), 0.2);
      }
}

TEST(FilmWriter, HevcInMp4SaysItsLayoutInABox) {
  const TemporaryFolder folder;
  make_film(folder / "a.mp4", 3, {.codec = "hevc", .layout = StereoLayout::top_bottom_half});
  EXPECT_EQ(open_film(folder / "a.mp4").facts().layout, StereoLayout::top_bottom_half);
  EXPECT_THAT(bytes_of(folder / "a.mp4"), testing::HasSubstr("st3d"));
  EXPECT_THAT(bytes_of(folder / "a.mp4"), testing::HasSubstr("hvc1"));
}

TEST(FilmWriter, ColourTagsAreKept) {
  const TemporaryFolder folder;
  const ColourTags tags{"bt2020nc", "tv", "bt2020", "smpte2084"};
  for (const char* name : {"a.mp4", "a.mkv"}) {
    for (const char* codec : {"h264", "hevc"}) {
      make_film(folder / name, 3, {.codec = codec, .colour = tags});
      EXPECT_EQ(open_film(folder / name).facts().colour, tags) << name << " " << codec;
    }
  }
}

TEST(FilmWriter, OddSizesArePaddedAndSaid) {
  const TemporaryFolder folder;
  FilmWriter writer(folder / "a.mp4");
  for (int i = 0; i < 3; ++i) writer.write(moving_frame(63, 47, i));
  writer.finish();
  EXPECT_THAT(writer.notes(), testing::ElementsAre(testing::HasSubstr("63x47 pixels become 64x48")));
  const Image<Rgb8> picture = frames_of(folder / "a.mp4")[1].picture;
  ASSERT_EQ(picture.width(), 64);
  ASSERT_EQ(picture.height(), 48);
  EXPECT_NEAR(picture(63, 20).g, picture(62, 20).g, 8);

  make_film(folder / "b.mp4", 3, {.pixel_format = "yuv444p"}, 63, 47);
  EXPECT_EQ(frames_of(folder / "b.mp4")[0].picture.width(), 63);
}

TEST(FilmWriter, NumberedPictures) {
  const TemporaryFolder folder;
  {
    FilmWriter abandoned(folder / "f_%03d.png");
    abandoned.write(moving_frame(20, 10, 0));
  }
  EXPECT_TRUE(folder.is_empty());
  make_film(folder / "f_%03d.png", 4, {}, 20, 10);
  EXPECT_TRUE(fs::exists(folder / "f_004.png"));
  const std::vector<Frame> frames = frames_of(folder / "f_%03d.png");
  ASSERT_EQ(frames.size(), 4u);
  EXPECT_EQ(frames[3].picture, moving_picture(20, 10, 3));
  expect_error(ErrorKind::wrong_usage, "f_001.png exists already", [&] { FilmWriter(folder / "f_%03d.png"); });
}

TEST(FilmWriter, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  const auto refused = [&](const char* name, const FilmWriterOptions& options, const char* part) {
    expect_error(ErrorKind::wrong_usage, part, [&] { FilmWriter(folder / name, options); });
  };
  refused("a.avi", {}, "films are written to");
  refused("a.mp4", {.codec = "mpeg9"}, "codec: mpeg9, expected one of h264, hevc");
  refused("a.webm", {.codec = "h264"}, "cannot hold h264, expected .mp4");
  refused("a.mp4", {.codec = "prores-hq"}, "cannot hold prores-hq, expected .mov");
  refused("a.mov", {.codec = "prores-hq", .crf = 10}, "no rate factor");
  expect_error(ErrorKind::wrong_usage, "codec: av9 is not in this installation's libavcodec (libav9)", [] {
    check_encoder({"av9", "libav9", 0, 0, 1, {"yuv420p"}, {".mkv"}});
  });
  refused("a.mp4", {.codec = "ffv1"}, "expected .mkv");
  refused("a.mp4", {.crf = 70}, "crf: 70");
  refused("a.mkv", {.codec = "ffv1", .crf = 10}, "no rate factor");
  refused("a.mp4", {.preset = "hurry"}, "preset: hurry");
  refused("a.mp4", {.pixel_format = "bgr0"}, "pixel format: bgr0");
  expect_error(ErrorKind::cannot_read_write, "the folder cannot be made", [&] { FilmWriter("/dev/null/no/a.mp4"); });

  FilmWriter writer(folder / "a.mp4");
  expect_error(ErrorKind::wrong_usage, "no frame", [&] { writer.finish(); });
  writer.write(moving_frame(64, 48, 5));
  expect_error(ErrorKind::wrong_usage, "62x48", [&] { writer.write(moving_frame(62, 48, 6)); });
  expect_error(ErrorKind::wrong_usage, "tick 5 after one at 5", [&] { writer.write(moving_frame(64, 48, 5)); });
}

TEST(FilmWriter, TheSameFramesGiveTheSameBytes) {
  const TemporaryFolder folder;
  for (const std::string codec : {"h264", "hevc", "ffv1", "hevc-10", "prores-hq", "prores-4444", "av1", "vp9"}) {
    make_film(folder / "a.mkv", 20, {.codec = codec});
    for (std::size_t i = 1; i < 6; ++i) {
      // Memory that was used: an encoder that reads what it did not write is found out.
      std::vector<std::vector<int>> used(200 * i, std::vector<int>(1000 + 97 * i, static_cast<int>(0x01010101 * i)));
      used.clear();
      make_film(folder / "b.mkv", 20, {.codec = codec});
      EXPECT_TRUE(bytes_of(folder / "a.mkv") == bytes_of(folder / "b.mkv")) << codec;
    }
  }
}

TEST(FilmWriter, AnAbandonedFilmLeavesNothing) {
  const TemporaryFolder folder;
  {
    FilmWriter writer(folder / "a.mp4");
    for (int i = 0; i < 30; ++i) writer.write(moving_frame(64, 48, i));
  }
  EXPECT_TRUE(folder.is_empty());
}

TEST(FilmWriter, AFullDiskIsNoticedAndLeavesNothing) {
  const TemporaryFolder folder;
  for (const char* name : {"a.mp4", "a.mkv", "a_%02d.png"}) {
    const bool is_sequence = name == std::string("a_%02d.png");
    std::uintmax_t length = 2000;
    if (!is_sequence) {
      make_film(folder / name, 30);
      length = fs::file_size(folder / name);
      fs::remove(folder / name);
    }
    // A limit on the size of files stands in for the end of the disk.
    rlimit usual{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &usual), 0);
    const auto usual_action = std::signal(SIGXFSZ, SIG_IGN);
    for (const std::uintmax_t most : {std::uintmax_t{0}, std::uintmax_t{100}, length / 2, length - 1}) {
      const rlimit tight{.rlim_cur = most, .rlim_max = usual.rlim_max};
      setrlimit(RLIMIT_FSIZE, &tight);
      SCOPED_TRACE(std::string(name) + " within " + std::to_string(most) + " bytes");
      expect_error(ErrorKind::cannot_read_write, "cannot", [&] { make_film(folder / name, 30); });
    }
    setrlimit(RLIMIT_FSIZE, &usual);
    std::signal(SIGXFSZ, usual_action);
    EXPECT_TRUE(folder.is_empty()) << name;
  }
}

}  // namespace wheatstone::film_writer_test
