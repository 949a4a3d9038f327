// Quilts and lenticular screens.

#include <gtest/gtest.h>

#include <cmath>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/image/whole_file.h"

namespace wheatstone {
namespace {

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

/// The formula by the book, in long double.
int expected_view(const LenticularScreen& s, int views, int x, int y, int c) {
  const long double p = s.pitch * s.width / s.dpi * std::cos(std::atan(1.0L / s.slope));
  const long double t = s.height / (s.width * static_cast<long double>(s.slope)) * (s.flip ? -1 : 1);
  const long double u = (x + 0.5L) / s.width;
  const long double v = 1 - (y + 0.5L) / s.height;
  const long double a = (u + c / (3.0L * s.width) + v * t) * p - s.center;
  return std::min(static_cast<int>((1 - (a - std::floor(a))) * views), views - 1);
}

TEST(Lenticular, EverySubPixelComesFromItsView) {
  LenticularScreen screen{.width = 300, .height = 200, .pitch = 47.58, .slope = -6.2, .center = 0.31, .dpi = 324};
  for (const bool flip : {false, true}) {
    screen.flip = flip;
    const Image<Rgb8> picture = interleave(numbered(45, 300, 200), screen);
    int off = 0;
    for (int y = 0; y < 200; ++y)
      for (int x = 0; x < 300; ++x) {
        off += picture(x, y).r != expected_view(screen, 45, x, y, 0);
        off += picture(x, y).g != expected_view(screen, 45, x, y, 1);
        off += picture(x, y).b != expected_view(screen, 45, x, y, 2);
        ASSERT_EQ(view_of_subpixel(screen, 45, x, y, 1), picture(x, y).g);
      }
    EXPECT_EQ(off, 0);
  }
}

TEST(Lenticular, NineViewsRepeatAfterThreePixelsAndStepByRow) {
  const LenticularScreen screen = find_lenticular("step-9");
  int off = 0;
  for (int y = 600; y < 620; ++y)
    for (int i = 30; i < 300; ++i) {
      const int here = view_of_subpixel(screen, 9, i / 3, y, i % 3);
      const int later = view_of_subpixel(screen, 9, (i + 9) / 3, y, (i + 9) % 3);
      const int next = view_of_subpixel(screen, 9, (i + 1) / 3, y, (i + 1) % 3);
      const int below = view_of_subpixel(screen, 9, (i + 1) / 3, y + 1, (i + 1) % 3);
      off += here != later;
      off += (here + 8) % 9 != next;
      off += here != below;
    }
  // Rounding may put what lies on the border between two views on either side.
  EXPECT_LE(off, 20 * 270 * 3 / 100);
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
  refused(R"({"screenW":1e9,"screenH":100,"pitch":1,"slope":1,"center":0,"DPI":100})", "no screen");
  expect_error(ErrorKind::wrong_usage, "step-9", [] { find_lenticular("moon"); });
}

}  // namespace
}  // namespace wheatstone
