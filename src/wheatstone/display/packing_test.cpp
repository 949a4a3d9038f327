// Anaglyphs, animations and files of many views.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "largest_difference.h"
#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/display/anaglyph.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/wiggle.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/pictures/multiview_exr.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::packing_test {

/// Colours of every kind, most of which no matrix leaves within range.
Image<Rgb8> noise(int width, int height, unsigned seed) {
  std::mt19937 random(seed);
  Image<Rgb8> picture(width, height);
  for (Rgb8& pixel : picture.pixels()) {
    const auto bits = random();
    pixel = {static_cast<std::uint8_t>(bits), static_cast<std::uint8_t>(bits >> 8),
             static_cast<std::uint8_t>(bits >> 16)};
  }
  return picture;
}

StereoPair noisy_pair() { return {noise(64, 48, 1), noise(64, 48, 2)}; }

bool has_ffmpeg() { return std::system("command -v ffmpeg >/dev/null") == 0; }

/// What ffmpeg's filter makes of a side-by-side picture, in each of its modes that are asked for, as "sbsl:arcd". It
/// starts once: that takes longer than all modes.
std::map<std::string, Image<Rgb8>> by_ffmpeg(const StereoPair& pair, const std::vector<std::string>& modes) {
  const TemporaryFolder folder;
  write_image(folder / "in.png", side_by_side(pair));
  std::string line = "ffmpeg -v error -i '" + (folder / "in.png").string() + "'";
  for (const std::string& mode : modes)
    line += " -vf stereo3d=" + mode + ",format=rgb24 '" + (folder / (mode + ".png")).string() + "'";
  EXPECT_EQ(std::system(line.c_str()), 0);
  std::map<std::string, Image<Rgb8>> made;
  for (const std::string& mode : modes) made[mode] = read_image(folder / (mode + ".png"));
  return made;
}

Image<Rgb8> repeated(const Image<Rgb8>& picture, int columns, int rows) {
  Image<Rgb8> large(columns * picture.width(), rows * picture.height());
  for (int y = 0; y < large.height(); ++y)
    for (int x = 0; x < large.width(); ++x) large(x, y) = picture(x / columns, y / rows);
  return large;
}

TEST(Packing, AnaglyphsAreAsFfmpegMakesThem) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const StereoPair pair = noisy_pair();
  const auto mode_of = [](const AnaglyphKind& kind) {
    // For these ffmpeg gives amber to the right eye, other than its documentation and its own Dubois mode have it.
    const bool swapped = kind.ffmpeg == "aybg" || kind.ffmpeg == "aybh" || kind.ffmpeg == "aybc";
    return (swapped ? "sbsr:" : "sbsl:") + std::string(kind.ffmpeg);
  };
  std::vector<std::string> modes;
  for (const AnaglyphKind& kind : anaglyph_kinds())
    if (!kind.ffmpeg.empty()) modes.push_back(mode_of(kind));
  EXPECT_EQ(modes.size(), 14u);
  const auto theirs = by_ffmpeg(pair, modes);
  for (const AnaglyphKind& kind : anaglyph_kinds()) {
    if (kind.ffmpeg.empty()) continue;
    EXPECT_LE(largest_difference(anaglyph(pair, kind), theirs.at(mode_of(kind))), 1) << kind.name;
  }
  // Dubois' own way is another one: in linear light.
  EXPECT_GT(largest_difference(anaglyph(pair), theirs.at("sbsl:arcd")), 10);
}

TEST(Packing, LayoutsAndRowsAreAsFfmpegMakesThem) {
  if (!has_ffmpeg()) GTEST_SKIP() << "ffmpeg is not installed";
  const StereoPair pair = noisy_pair();
  const auto theirs =
      by_ffmpeg(pair, {"sbsl:sbsl", "sbsl:sbsr", "sbsl:abl", "sbsl:abr", "sbsl:icl", "sbsl:chl", "sbsl:irl"});
  for (const auto& [layout, mode] : {std::pair{StereoLayout::left_right, "sbsl:sbsl"},
                                     {StereoLayout::right_left, "sbsl:sbsr"},
                                     {StereoLayout::top_bottom, "sbsl:abl"},
                                     {StereoLayout::bottom_top, "sbsl:abr"}})
    EXPECT_EQ(put_together(pair.left, pair.right, layout), theirs.at(mode)) << mode;
  // ffmpeg keeps all pixels of both, and its picture is twice as large: a screen of that size, on which the views were
  // doubled, shows the same.
  const auto interleaved = [&](int columns, int rows, StereoLayout layout) {
    return put_together(repeated(pair.left, columns, rows), repeated(pair.right, columns, rows), layout);
  };
  EXPECT_EQ(interleaved(2, 1, StereoLayout::even_odd_columns), theirs.at("sbsl:icl"));
  EXPECT_EQ(interleaved(2, 1, StereoLayout::checkerboard), theirs.at("sbsl:chl"));
  EXPECT_EQ(interleaved(1, 2, StereoLayout::even_odd_rows), theirs.at("sbsl:irl"));
}

TEST(Packing, LayoutsComeApartAgain) {
  const StereoPair pair = noisy_pair();
  for (const LayoutTraits& traits : stereo_layouts()) {
    if (traits.half || !is_packed(traits.layout)) continue;
    const StereoPair back = cut_apart(put_together(pair.left, pair.right, traits.layout), traits.layout, "it");
    EXPECT_EQ(back.left, pair.left) << traits.name;
    EXPECT_EQ(back.right, pair.right) << traits.name;
  }
}

TEST(MultiviewExr, GivesTheViewsBack) {
  const TemporaryFolder folder;
  for (const std::size_t count : {2u, 9u}) {
    std::vector<Image<Rgb8>> views;
    for (std::size_t v = 0; v < count; ++v) views.push_back(noise(37, 21, static_cast<unsigned>(v)));
    write_multiview_exr(folder / "views.exr", views);
    EXPECT_TRUE(is_multiview_exr(folder / "views.exr"));
    const std::vector<Image<Rgb8>> back = read_multiview_exr(folder / "views.exr");
    ASSERT_EQ(back.size(), count);
    // Half floats have eleven bits: every 8-bit value comes back.
    for (std::size_t v = 0; v < count; ++v) EXPECT_EQ(back[v], views[v]) << v;
  }
  EXPECT_EQ(view_names(2), (std::vector<std::string>{"left", "right"}));
}

TEST(MultiviewExr, RefusesWhatItIsNot) {
  const TemporaryFolder folder;
  const std::vector<Image<Rgb8>> views{noise(8, 8, 1), noise(8, 8, 2)};
  write_multiview_exr(folder / "views.exr", views);
  const std::string whole = read_whole_file(folder / "views.exr", 1 << 20);
  for (std::size_t length = 0; length < whole.size(); length += 7) {
    write_whole_file(folder / "cut.exr", whole.substr(0, length));
    expect_error(ErrorKind::bad_input, "cut.exr: ", [&] { read_multiview_exr(folder / "cut.exr"); });
  }
  expect_error(ErrorKind::wrong_usage, "1 views",
               [&] { write_multiview_exr(folder / "one.exr", std::span(views).first(1)); });
  EXPECT_FALSE(is_multiview_exr(folder / "nothing.exr"));
}

TEST(Wiggle, GoesThereAndBack) {
  const TemporaryFolder folder;
  const std::vector<Image<Rgb8>> views{Image<Rgb8>(20, 10, {255, 0, 0}), Image<Rgb8>(20, 10, {0, 255, 0}),
                                       Image<Rgb8>(20, 10, {0, 0, 255})};
  write_wiggle(folder / "a.gif", views);
  const std::string gif = read_whole_file(folder / "a.gif", 1 << 20);
  EXPECT_TRUE(gif.starts_with("GIF89a"));
  // Three views, four frames: each has an image descriptor of the whole size.
  const std::string descriptor{",\0\0\0\0\x14\0\n\0", 9};
  int frames = 0;
  for (std::size_t at = gif.find(descriptor); at != std::string::npos; at = gif.find(descriptor, at + 1)) ++frames;
  EXPECT_EQ(frames, 4);
  write_wiggle(folder / "a.webp", views);
  const std::string webp = read_whole_file(folder / "a.webp", 1 << 20);
  EXPECT_NE(webp.find("ANIM"), std::string::npos);
  EXPECT_EQ(read_image(folder / "a.webp")(5, 5), (Rgb8{255, 0, 0}));
}

TEST(Wiggle, RefusesOtherEndingsAndLoneViews) {
  const TemporaryFolder folder;
  const std::vector<Image<Rgb8>> views{noise(8, 8, 1), noise(8, 8, 2)};
  expect_error(ErrorKind::wrong_usage, ".gif or .webp", [&] { write_wiggle(folder / "a.png", views); });
  expect_error(ErrorKind::wrong_usage, "1 views", [&] { write_wiggle(folder / "a.gif", std::span(views).first(1)); });
  expect_error(ErrorKind::cannot_read_write, "cannot write", [&] { write_wiggle("/dev/null/a.gif", views); });
}

TEST(ShiftedViews, BringOneDisparityToTheSameColumn) {
  for (const int disparity : {4, -3, 0}) {
    std::vector<Image<Rgb8>> views;
    for (int v = 0; v < 5; ++v) {
      views.emplace_back(60, 2);
      views.back()(30 - v * disparity, 1) = {255, 255, 255};
    }
    const std::vector<Image<Rgb8>> moved = shifted_views(views, static_cast<float>(disparity));
    EXPECT_EQ(moved.front().width(), 60 - 4 * std::abs(disparity));
    for (const Image<Rgb8>& view : moved) EXPECT_EQ(view, moved.front());
  }
}

TEST(FloatingWindow, BlackensTheOuterEdgesOnly) {
  StereoPair pair{Image<Rgb8>(10, 1, {9, 9, 9}), Image<Rgb8>(10, 1, {9, 9, 9})};
  put_floating_window(pair, 2, 3);
  for (int x = 0; x < 10; ++x) {
    EXPECT_EQ(pair.left(x, 0).r, x < 2 ? 0 : 9);
    EXPECT_EQ(pair.right(x, 0).r, x < 7 ? 9 : 0);
  }
}

TEST(DepthBeside, IsWhiteWhereItIsNear) {
  Image<float> disparity(100, 2);
  for (int x = 0; x < 100; ++x) disparity(x, 0) = disparity(x, 1) = static_cast<float>(x);
  const Image<Rgb8> both = depth_beside(Image<Rgb8>(100, 2, {1, 2, 3}), disparity);
  EXPECT_EQ(both.width(), 200);
  EXPECT_EQ(both(50, 1), (Rgb8{1, 2, 3}));
  EXPECT_EQ(both(199, 0).g, 255);
  EXPECT_EQ(both(100, 0).g, 0);
  EXPECT_NEAR(both(150, 0).g, 128, 3);
}

}  // namespace wheatstone::packing_test
