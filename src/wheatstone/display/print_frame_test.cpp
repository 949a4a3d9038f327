// Crops, borders, captions and floating windows.

#include "wheatstone/display/print_frame.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "throws_error.h"
#include "wheatstone/display/arrange.h"
#include "wheatstone/display/lettering.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::print_frame_test {

constexpr std::string_view option = "--crop";

Image<Rgb8> coordinates(int width, int height) {
  Image<Rgb8> picture(width, height);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) picture(x, y) = {std::uint8_t(x), std::uint8_t(y), 0};
  return picture;
}

TEST(Crop, TakesThePartThatIsTyped) {
  const Image<Rgb8> picture = coordinates(120, 90);
  const auto part = [&](std::string_view words) { return cropped(picture, parse_crop(words, option)); };
  EXPECT_EQ(part("30x20+5+7").width(), 30);
  EXPECT_EQ(part("30x20+5+7")(0, 0), (Rgb8{5, 7, 0}));
  EXPECT_EQ(part("30x20+5+7")(29, 19), (Rgb8{34, 26, 0}));
  EXPECT_EQ(part("30x20")(0, 0), (Rgb8{45, 35, 0}));
  EXPECT_EQ(part("1:1").width(), 90);
  EXPECT_EQ(part("1:1")(0, 0), (Rgb8{15, 0, 0}));
  EXPECT_EQ(part("16:9").height(), 68);
  EXPECT_EQ(part("120x90+0+0"), picture);
}

TEST(Crop, RefusesWhatIsNoPart) {
  const Image<Rgb8> picture = coordinates(120, 90);
  for (const char* words : {"", "12", "0x5", "x", "30x20+5", "30x20+5+7+9", "30x20-5+7", "4:", "0:3", ":", "nan:1",
                            "inf:1", "1e300:1e-300", "30 x20", "99999999999x1", "4:3x"})
    expect_error(ErrorKind::wrong_usage, "--crop: is '", [&] { parse_crop(words, option); });
  for (const char* words : {"121x1+0+0", "1x91", "30x20+91+0", "30x20+0+71", "30x20+2147483647+0", "2147483647x1+1+0"})
    expect_error(ErrorKind::wrong_usage, "does not lie within the views of 120x90",
                 [&] { cropped(picture, parse_crop(words, option)); });
}

TEST(Border, StandsAroundThePictureAndTheCaptionBelow) {
  const Image<Rgb8> picture = coordinates(120, 90);
  PrintFrame frame{.crop = {}, .border = Border{.width = 0.05f, .is_share = true, .colour = {0, 0, 0}}, .caption = {}};
  const Image<Rgb8> plain = with_border_and_caption(picture, frame);
  EXPECT_EQ(plain.width(), 132);
  EXPECT_EQ(plain.height(), 102);
  EXPECT_EQ(plain(5, 5), Rgb8{});
  EXPECT_EQ(plain(6, 6), picture(0, 0));
  EXPECT_EQ(plain(125, 95), picture(119, 89));
  frame.caption = "Äpfel";
  const Image<Rgb8> named = with_border_and_caption(picture, frame);
  EXPECT_GT(named.height(), plain.height());
  EXPECT_EQ(named(6, 6), picture(0, 0));
  int light = 0, outside = 0;
  for (int y = 96; y < named.height(); ++y)
    for (int x = 0; x < named.width(); ++x) {
      light += named(x, y).r > 180 ? 1 : 0;
      outside += named(x, y).r > 60 && (x < 40 || x > 92) ? 1 : 0;
    }
  EXPECT_GT(light, 20);
  EXPECT_EQ(outside, 0);  // in the middle
}

TEST(Lettering, BreaksLinesBetweenWordsAndSetsLongWordsSmaller) {
  const Lettering one = set_text("two words", 20, 400), two = set_text("two words", 20, 70);
  EXPECT_EQ(one.lines, 1);
  EXPECT_EQ(two.lines, 2);
  EXPECT_EQ(set_text("two\nwords", 20, 400).lines, 2);
  EXPECT_LT(set_text("incomprehensibilities", 20, 70).cover.height(), one.cover.height());
  // The letters of many scripts, each in one font.
  for (const char* words : {"Größe", "Ελλάδα", "Москва", "café №5 – ½"}) {
    const Lettering set = set_text(words, 30, 600);
    EXPECT_GT(std::ranges::count_if(set.cover.pixels(), [](int share) { return share > 200; }), 100) << words;
  }
  expect_error(ErrorKind::wrong_usage, "not UTF-8", [] { set_text("\xff\xfe", 20, 100); });
  expect_error(ErrorKind::cannot_read_write, "no TrueType font", [] { set_text("\xf4\x8f\xbf\xbd", 20, 100); });
}

/// A pair whose nearest things are far before the screen, and cut by its frame.
StereoPair near_pair(StereoGeometry& geometry) {
  SyntheticStill still = make_synthetic_still({.width = 240, .height = 180, .samples_a_side = 1});
  geometry = std::move(still.geometry);
  return std::move(still.pictures);
}

/// How many pixels of things before the screen one eye alone sees beside the other's frame.
int cut_for_one_eye(const StereoGeometry& geometry, const FloatingWindow& window) {
  int cut = 0;
  const int width = geometry.left_disparity.width();
  for (int y = 0; y < geometry.left_disparity.height(); ++y)
    for (int x = 0; x < width; ++x) {
      const float left = geometry.left_disparity(x, y), right = geometry.right_disparity(x, y);
      const auto centre = static_cast<float>(x) + 0.5f;
      cut += x >= window.left_px && left > 0 && centre - left < 0 ? 1 : 0;
      cut += x < width - window.right_px && right > 0 && centre + right > static_cast<float>(width) ? 1 : 0;
    }
  return cut;
}

TEST(FloatingWindow, LeavesNothingBeforeTheScreenCutForOneEyeOnlyAndIsTheNarrowestThatDoes) {
  StereoGeometry geometry;
  near_pair(geometry);
  const FloatingWindow window = floating_window_for(geometry, 0);
  EXPECT_GT(window.left_px, 1);
  EXPECT_GT(window.right_px, 1);
  EXPECT_GT(cut_for_one_eye(geometry, {}), 100);
  EXPECT_EQ(cut_for_one_eye(geometry, window), 0);
  EXPECT_GT(cut_for_one_eye(geometry, {window.left_px - 1, window.right_px}), 0);
  EXPECT_GT(cut_for_one_eye(geometry, {window.left_px, window.right_px - 1}), 0);
}

TEST(FloatingWindow, IsNoneWhereEverythingLiesBehindTheScreen) {
  StereoGeometry geometry;
  near_pair(geometry);
  for (Image<float>* disparity : {&geometry.left_disparity, &geometry.right_disparity})
    for (float& d : disparity->pixels()) d -= 100;
  EXPECT_EQ(floating_window_for(geometry), FloatingWindow());
}

}  // namespace wheatstone::print_frame_test
