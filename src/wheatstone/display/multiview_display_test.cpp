// Quilts and lenticular screens.

#include <gtest/gtest.h>
#include <hwy/targets.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <set>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone::multiview_display_test {

/// Views of one colour each: their number, in every channel.
std::vector<Image<Rgb8>> numbered(int count, int width, int height) {
  std::vector<Image<Rgb8>> views;
  for (int v = 0; v < count; ++v) {
    const auto number = static_cast<std::uint8_t>(v);
    views.emplace_back(width, height, Rgb8{number, number, number});
  }
  return views;
}

TEST(Quilt, BeginsAtTheBottomLeftAndGoesUp) {
  const Image<Rgb8> quilt = make_quilt(numbered(6, 4, 2), {.columns = 3, .rows = 2});
  EXPECT_EQ(quilt.width(), 12);
  EXPECT_EQ(quilt.height(), 4);
  EXPECT_EQ(quilt(0, 3).r, 0);
  EXPECT_EQ(quilt(11, 3).r, 2);
  EXPECT_EQ(quilt(0, 0).r, 3);
  EXPECT_EQ(quilt(11, 0).r, 5);
}

TEST(Quilt, IsCutIntoTheViewsThatMadeIt) {
  const std::vector<Image<Rgb8>> views = numbered(45, 5, 3);
  const QuiltLayout layout{.columns = 5, .rows = 9};
  EXPECT_EQ(views_of_quilt(make_quilt(views, layout), layout), views);
}

TEST(Quilt, IsNamedAsItsDisplayExpects) {
  EXPECT_EQ(quilt_name("gas", {8, 6}, 0.75), "gas_qs8x6a0.75.png");
  EXPECT_EQ(quilt_name("gas", {5, 9}, 16. / 9), "gas_qs5x9a1.7778.png");
}

TEST(Quilt, RefusesTheWrongNumberOfViews) {
  expect_error(ErrorKind::wrong_usage, "48", [] { make_quilt(numbered(47, 2, 2), {8, 6}); });
  expect_error(ErrorKind::wrong_usage, "quilt", [] { views_of_quilt(Image<Rgb8>(7, 6), {2, 2}); });
}

/// Where the formula puts a sub-pixel, in long double: how many views it is from the first one's beginning.
long double expected_place(const LenticularScreen& s, int views, int x, int y, int channel) {
  const long double c = s.blue_first ? 2 - channel : channel;
  const long double p = s.pitch * s.width / s.dpi * std::cos(std::atan(1.0L / s.slope));
  const long double t = s.height / (s.width * static_cast<long double>(s.slope)) * (s.flip ? -1 : 1);
  const long double u = (x + 0.5L) / s.width;
  const long double v = 1 - (y + 0.5L) / s.height;
  const long double a = (u + c / (3.0L * s.width) + v * t) * p - s.center;
  const long double part = a - std::floor(a);
  return (s.first_from_left ? part : 1 - part) * views;
}

TEST(Lenticular, EverySubPixelComesFromItsView) {
  // Odd sizes, a width that no vector divides, and every way to turn the screen.
  for (int turned = 0; turned < 8; ++turned) {
    const LenticularScreen screen{.width = 301,
                                  .height = 143,
                                  .pitch = 47.58,
                                  .slope = -6.2,
                                  .center = 0.31,
                                  .dpi = 324,
                                  .flip = (turned & 1) != 0,
                                  .blue_first = (turned & 2) != 0,
                                  .first_from_left = (turned & 4) != 0};
    for (const int views : {1, 2, 45, 66}) {
      const Image<Rgb8> picture = interleave(numbered(views, 301, 143), screen);
      int off = 0;
      int on_border = 0;
      for (int y = 0; y < 143; ++y)
        for (int x = 0; x < 301; ++x)
          for (int c = 0; c < 3; ++c) {
            const int shown = (&picture(x, y).r)[c];
            const long double place = expected_place(screen, views, x, y, c);
            // Within rounding of a border between two views either may be shown.
            on_border += std::abs(place - std::round(place)) < 1e-9L;
            off += shown != static_cast<int>(place);
            off += view_of_subpixel(screen, views, x, y, c) != shown;
          }
      EXPECT_EQ(off, 0) << turned << " " << views;
      EXPECT_EQ(on_border, 0);
    }
  }
}

TEST(Lenticular, WholeRowsStayExactAcrossTheWidestScreen) {
  const LenticularScreen screen{.width = 32768, .height = 9, .pitch = 52.1, .slope = 5.9, .center = -0.4, .dpi = 283};
  std::vector<std::uint16_t> row(std::size_t{3} * 32768);
  for (const int views : {9, 100, 65535}) {
    views_of_row(screen, views, 4, row);
    int off = 0;
    for (int i = 0; i < 3 * 32768; ++i) {
      const long double place = expected_place(screen, views, i / 3, 4, i % 3);
      // A lens is told apart into 2^32 parts.
      if (std::abs(place - std::round(place)) > views * 0x1p-32L + 1e-9L) off += row[i] != static_cast<int>(place);
    }
    EXPECT_EQ(off, 0) << views;
  }
}

TEST(Lenticular, RowsAreTheSameWithEveryInstructionSet) {
  for (const auto target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    for (const int width : {1, 2, 3, 7, 33, 301}) {
      const LenticularScreen screen{.width = width, .height = 9, .pitch = 52.1, .slope = 5.9, .center = -0.4};
      std::vector<std::uint16_t> row(3 * static_cast<std::size_t>(width)), expected;
      for (const int views : {1, 2, 9, 100, 65535}) {
        views_of_row(screen, views, 4, row);
        expected.clear();
        for (int i = 0; i < 3 * width; ++i)
          expected.push_back(static_cast<std::uint16_t>(view_of_subpixel(screen, views, i / 3, 4, i % 3)));
        EXPECT_EQ(row, expected) << hwy::TargetName(target) << ", " << width << " pixels, " << views << " views";
      }
    }
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(Lenticular, NineViewsRepeatAfterThreePixelsAndStepByRow) {
  const LenticularScreen screen = find_lenticular("step-9");
  for (int y = 600; y < 620; ++y)
    for (int i = 30; i < 300; ++i) {
      const auto view = [&](int subpixel, int row) {
        return view_of_subpixel(screen, 9, subpixel / 3, row, subpixel % 3);
      };
      ASSERT_EQ(view(i, y), view(i + 9, y));
      ASSERT_EQ((view(i, y) + 8) % 9, view(i + 1, y));
      ASSERT_EQ(view(i, y), view(i + 1, y + 1));
    }
}

TEST(Lenticular, NamedScreensGiveEachViewItsShareOfEachColour) {
  int displays = 0;
  for (const DisplayPreset& display : display_presets()) {
    if (display.lenses.screen_width_px == 0) continue;
    ++displays;
    const std::string name(display.name);
    const LenticularScreen screen = find_lenticular(name);
    const int views = display.views;
    // A part of the screen in which the pattern repeats a whole number of times.
    const int columns = 360;
    const int rows = 360;
    std::vector<std::uint16_t> row(std::size_t{3} * columns);
    std::vector<std::array<int, 3>> count(views);
    for (int y = 0; y < rows; ++y) {
      views_of_row(screen, views, y, row);
      for (int i = 0; i < 3 * columns; ++i) ++count[row[i]][i % 3];
    }
    for (int v = 0; v < views; ++v)
      for (const int c : {0, 1, 2}) EXPECT_EQ(count[v][c], columns * rows / views) << name << " " << v << " " << c;
  }
  EXPECT_EQ(displays, 6);
  expect_error(ErrorKind::wrong_usage, "desk-stereo", [] { lenticular_screen_of(find_display("desk-stereo")); });
}

TEST(Lenticular, Philips36LeansAsItsSlitsDo) {
  // arctan(1/6) = 9.46 degrees: six rows down are one pixel to the side.
  const LenticularScreen screen = find_lenticular("philips-36");
  EXPECT_EQ(screen.width, 3200);
  for (int x = 10; x < 40; ++x)
    for (const int c : {0, 1, 2})
      ASSERT_EQ(view_of_subpixel(screen, 36, x, 100, c), view_of_subpixel(screen, 36, x + 1, 106, c));
}

TEST(Lenticular, IsTheSameOnAnyNumberOfThreads) {
  std::vector<Image<Rgb8>> views;
  for (int v = 0; v < 9; ++v) {
    views.emplace_back(64, 36);
    for (int y = 0; y < 36; ++y)
      for (int x = 0; x < 64; ++x)
        views[v](x, y) = {std::uint8_t(v * 7 + x), std::uint8_t(y * 3 + v), std::uint8_t(x * y)};
  }
  const LenticularScreen screen{.width = 192, .height = 108, .pitch = 31, .slope = 3.3};
  const Image<Rgb8> many = interleave(views, screen);
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(interleave(views, screen), many);
}

TEST(Lenticular, SmallViewsAreReadWhereTheSubPixelIs) {
  std::vector<Image<Rgb8>> views = numbered(2, 4, 2);
  views[1](3, 1) = views[0](3, 1) = {200, 200, 200};
  const Image<Rgb8> picture = interleave(views, {.width = 8, .height = 4, .pitch = 100, .slope = 1e9, .dpi = 100});
  EXPECT_EQ(picture(7, 3).g, 200);
  EXPECT_EQ(picture(6, 2).g, 200);
  EXPECT_LT(picture(5, 3).g, 2);
}

TEST(Lenticular, ReadsALookingGlassCalibration) {
  const TemporaryFolder folder;
  write_whole_file(folder / "visual.json",
                   R"({"pitch":{"value":47.6},"slope":{"value":-5.4},"center":{"value":-0.4},"DPI":{"value":338.0},)"
                   R"("screenW":{"value":1536.0},"screenH":{"value":2048.0},"flipImageX":{"value":0.0}})");
  const LenticularScreen screen = find_lenticular((folder / "visual.json").string());
  EXPECT_EQ(screen.width, 1536);
  EXPECT_EQ(screen.height, 2048);
  EXPECT_EQ(screen.pitch, 47.6);
  EXPECT_EQ(screen.slope, -5.4);
  EXPECT_FALSE(screen.flip || screen.blue_first || screen.first_from_left);
}

TEST(Lenticular, CalibrationTellsWhichWayThingsLie) {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& more) {
    write_whole_file(folder / "visual.json",
                     R"({"screenW":100,"screenH":50,"pitch":1,"slope":-5,"center":0,"DPI":100)" + more + "}");
    return read_calibration(folder / "visual.json");
  };
  EXPECT_TRUE(with(R"(,"flipImageX":1)").flip);
  EXPECT_TRUE(with(R"(,"flipSubp":{"value":1.0})").blue_first);
  EXPECT_TRUE(with(R"(,"invView":0.0)").first_from_left);
  EXPECT_FALSE(with(R"(,"invView":true)").first_from_left);
}

TEST(Lenticular, RefusesBadCalibrationsAndUnknownNames) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& text, const std::string& part) {
    write_whole_file(folder / "visual.json", text);
    expect_error(ErrorKind::bad_input, part, [&] { read_calibration(folder / "visual.json"); });
  };
  refused("", "JSON");
  refused("[1,2]", "JSON");
  refused(R"({"screenW":100,"screenH":100,"pitch":1})", "slope");
  refused(R"({"screenW":100,"screenH":100,"pitch":1,"slope":"steep"})", "slope");
  refused(R"({"screenW":1e9,"screenH":100,"pitch":1,"slope":1,"center":0,"DPI":100})",
          "does not describe a valid screen");
  refused(R"({"screenW":100,"screenH":100,"pitch":1e300,"slope":1,"center":0,"DPI":1e-9})",
          "does not describe a valid screen");
  refused(R"({"screenW":100,"screenH":100,"pitch":1,"slope":1e-9,"center":0,"DPI":100})",
          "does not describe a valid screen");
  refused(R"({"screenW":100,"screenH":100,"pitch":1,"slope":0,"center":0,"DPI":100})",
          "does not describe a valid screen");
  expect_error(ErrorKind::wrong_usage, "no views", [] { interleave({}, {}); });
  expect_error(ErrorKind::wrong_usage, "one size", [] {
    std::vector<Image<Rgb8>> views = numbered(2, 4, 4);
    views[1] = Image<Rgb8>(3, 4);
    interleave(views, {});
  });
  expect_error(ErrorKind::wrong_usage, "step-9", [] { find_lenticular("moon"); });
}

}  // namespace wheatstone::multiview_display_test
