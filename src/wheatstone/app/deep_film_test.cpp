// Films of ten bits keep them from the source to the painted film.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "temporary_folder.h"
#include "wheatstone/app/film_plan.h"
#include "wheatstone/app/pack_film.h"
#include "wheatstone/app/rotoscope_film.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone::deep_film_test {

namespace fs = std::filesystem;

constexpr int bar_px = 64, bars = 16, height = 256, first_code = 500;

/// A grey of ten bits.
std::uint16_t deep_grey(int code) { return static_cast<std::uint16_t>(std::lround(code * 65535. / 1023)); }

/// Bars, each lighter than the one before by a step of ten bits.
Image<Rgb16> ramp() {
  Image<Rgb16> deep(bars * bar_px, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < deep.width(); ++x) {
      const std::uint16_t code = deep_grey(first_code + x / bar_px);
      deep(x, y) = {code, code, code};
    }
  return deep;
}

/// A film of it for two eyes that see the same.
void make_ramp(const fs::path& path) {
  SegmentedFilm writer(path, {.codec = "ffv1", .pixel_format = "gbrp16le", .layout = StereoLayout::left_right}, {});
  const Image<Rgb16> deep = ramp();
  Image<Rgb8> picture(deep.width(), deep.height());
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < deep.width(); ++x) {
      const auto level = static_cast<std::uint8_t>((deep(x, y).r + deep_level / 2) / deep_level);
      picture(x, y) = {level, level, level};
    }
  for (int i = 0; i < 2; ++i)
    writer.write({put_together(picture, picture, StereoLayout::left_right),
                  i,
                  {1, 24},
                  1,
                  put_together(deep, deep, StereoLayout::left_right)});
  writer.finish();
}

RotoscopeFilmOptions options_of(const std::string& codec, const std::string& format) {
  RotoscopeFilmOptions options;
  options.frames.style = style_by_name("impressionist");
  options.frames.deep = true;
  options.writing = {.codec = codec, .pixel_format = format, .layout = StereoLayout::left_right};
  options.reading.deep = true;
  options.version = "1.2.3";
  return options;
}

void paint(const fs::path& source, const fs::path& output, const RotoscopeFilmOptions& options) {
  StereoFilmReader film = open_stereo_film(source, {}, options.reading);
  rotoscope_film(film, output, options);
}

/// The codes of ten bits that many pixels of the last frame's left eye have.
std::vector<int> codes_in(const fs::path& path, std::optional<StereoLayout> layout = {}) {
  StereoFilmReader film = open_stereo_film(path, layout, {.deep = true});
  StereoFrame frame;
  while (film.read(frame)) continue;
  std::map<int, int> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < bars * bar_px; ++x) {
      const double grey = frame.left_deep.empty() ? frame.left(x, y).g * deep_level : frame.left_deep(x, y).g;
      ++pixels[static_cast<int>(std::lround(grey * 1023 / 65535))];
    }
  std::vector<int> codes;
  for (const auto& [code, count] : pixels)
    if (count > bars * bar_px * height / 200) codes.push_back(code);
  return codes;
}

std::vector<int> expected_codes() {
  std::vector<int> codes(bars);
  std::iota(codes.begin(), codes.end(), first_code);
  return codes;
}

// Broad strokes cross the borders of bars, and bring their colours: which codes there are tells what bits are kept.
TEST(DeepFilm, PaintedRampHasNoStepThatEightBitsWouldMake) {
  const TemporaryFolder folder;
  make_ramp(folder / "ramp.mkv");
  paint(folder / "ramp.mkv", folder / "deep.mkv", options_of("ffv1", "gbrp16le"));
  EXPECT_EQ(codes_in(folder / "deep.mkv"), expected_codes());

  RotoscopeFilmOptions flat = options_of("ffv1", "bgr0");
  flat.frames.deep = flat.reading.deep = false;
  paint(folder / "ramp.mkv", folder / "flat.mkv", flat);
  EXPECT_LE(codes_in(folder / "flat.mkv").size(), 5u);
}

TEST(DeepFilm, IsWrittenAsNumberedPicturesOfSixteenBitsAndNoOtherFilmIs) {
  const TemporaryFolder folder;
  make_ramp(folder / "ramp.mkv");
  RotoscopeFilmOptions options = options_of("h264", sixteen_bits);
  paint(folder / "ramp.mkv", folder / "deep_%d.png", options);
  EXPECT_EQ(codes_in(folder / "deep_%d.png", StereoLayout::left_right), expected_codes());
  options.writing.pixel_format.clear();
  paint(folder / "ramp.mkv", folder / "flat_%d.png", options);
  EXPECT_TRUE(read_deep_image(folder / "flat_1.png").empty());
}

TEST(DeepFilm, IsReadFromNumberedPicturesOfSixteenBits) {
  const TemporaryFolder folder;
  const Image<Rgb16> eyes = put_together(ramp(), ramp(), StereoLayout::left_right);
  for (const char* name : {"ramp_1.png", "ramp_2.png"}) write_image(folder / name, eyes);
  StereoFilmReader film =
      open_stereo_film(folder / "ramp_%d.png", StereoLayout::left_right, {.sequence_rate = {24, 1}, .deep = true});
  rotoscope_film(film, folder / "deep.mkv", options_of("ffv1", "gbrp16le"));
  EXPECT_EQ(codes_in(folder / "deep.mkv"), expected_codes());
}

TEST(DeepFilm, IsPackedWithItsBitsIfBothEyesHaveThem) {
  const TemporaryFolder folder;
  make_ramp(folder / "ramp.mkv");
  const FilmWriterOptions deep{.codec = "ffv1", .pixel_format = "gbrp16le", .layout = StereoLayout::top_bottom};
  StereoFilmReader ramp = open_stereo_film(folder / "ramp.mkv", {}, {.deep = true});
  pack_film(ramp, folder / "packed.mkv", {.writing = deep, .anaglyph = {}, .right_film = {}});
  EXPECT_EQ(codes_in(folder / "packed.mkv").size(), std::size_t{bars});
  // The right eye in 8 bits.
  for (const bool is_deep : {true, false}) {
    FilmWriterOptions of_eye{.codec = "ffv1", .pixel_format = is_deep ? "gbrp16le" : "bgr0"};
    StereoFilmReader source = open_stereo_film(folder / "ramp.mkv", {}, {.deep = true});
    SegmentedFilm eye(folder / (is_deep ? "l.mkv" : "r.mkv"), of_eye, {});
    for (StereoFrame frame; source.read(frame);)
      eye.write({frame.left, frame.pts, frame.time_base, frame.duration, is_deep ? frame.left_deep : Image<Rgb16>()});
    eye.finish();
  }
  StereoFilmReader mixed = open_eye_films(folder / "l.mkv", folder / "r.mkv", {.deep = true});
  pack_film(mixed, folder / "mixed.mkv", {.writing = deep, .anaglyph = {}, .right_film = {}});
  EXPECT_LE(codes_in(folder / "mixed.mkv").size(), 5u);
}

TEST(DeepFilm, IsTheSameWhenItIsPlannedFirst) {
  const TemporaryFolder folder;
  make_ramp(folder / "ramp.mkv");
  RotoscopeFilmOptions options = options_of("prores-hq", "");
  paint(folder / "ramp.mkv", folder / "whole.mkv", options);
  options.plan = folder / "film.plan";
  paint(folder / "ramp.mkv", folder / "parts.mkv", options);
  const FilmPlan plan = read_film_plan(options.plan, options.version);
  draw_film_part(options.plan, plan, {1, 2});
  join_film_parts(options.plan, plan);
  EXPECT_TRUE(bytes_of(folder / "whole.mkv") == bytes_of(folder / "parts.mkv"));
}

}  // namespace wheatstone::deep_film_test
