#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "compose.h"
#include "output_mode.h"
#include "throws_error.h"

namespace wheatstone::viewer::frame_test {

constexpr Rgb8 white{255, 255, 255}, black{};

/// Which eye each pixel of a screen shows: the left one's picture is white.
Image<Rgb8> interlaced(std::string_view mode, const Viewport& viewport) {
  return compose(find_output_mode(mode), Image<Rgb8>(viewport.width, viewport.height, white),
                 Image<Rgb8>(viewport.width, viewport.height, black), viewport)
      .picture;
}

TEST(OutputMode, HasTheNamesOfPack) {
  for (const char* name : {"red-cyan", "left-right-half", "even-odd-rows", "checkerboard", "wiggle", "lenticular"})
    EXPECT_EQ(find_output_mode(name).name, name);
  expect_error(ErrorKind::wrong_usage, "expected one of: left", [] { find_output_mode("red-blue-green"); });
}

TEST(OutputMode, InterlacedEyesKeepTheirPlacesOnTheScreenWhenTheWindowMoves) {
  for (const char* mode : {"even-odd-rows", "odd-even-rows", "even-odd-columns", "checkerboard"}) {
    const Image<Rgb8> screen = interlaced(mode, {12, 10, 0, 0});
    for (int left = 0; left < 3; ++left)
      for (int top = 0; top < 3; ++top) {
        const Image<Rgb8> window = interlaced(mode, {8, 6, left, top});
        for (int y = 0; y < window.height(); ++y)
          for (int x = 0; x < window.width(); ++x)
            EXPECT_EQ(window(x, y), screen(x + left, y + top)) << mode << ' ' << left << ' ' << top;
      }
    const bool changes = interlaced(mode, {8, 6, 0, 0}) != interlaced(mode, {8, 6, 1, 0}) ||
                         interlaced(mode, {8, 6, 0, 0}) != interlaced(mode, {8, 6, 0, 1});
    EXPECT_TRUE(changes) << mode << " would be right by chance";
  }
}

TEST(OutputMode, EveryOneFillsTheViewportWhateverItsSize) {
  for (const OutputMode& mode : output_modes()) {
    if (shows_display_views(mode)) continue;
    for (const Viewport viewport : {Viewport{64, 48}, Viewport{63, 47}, Viewport{3, 2}}) {
      const PictureSize eye = eye_size(mode, viewport);
      const Image<Rgb8> picture(eye.width, eye.height, white);
      const Frame frame = compose(mode, picture, picture, viewport);
      EXPECT_EQ(frame.picture.width(), viewport.width) << mode.name;
      EXPECT_EQ(frame.picture.height(), viewport.height) << mode.name;
    }
  }
}

TEST(FrameGeometry, TellsWhichPlaceOfWhichEyeIsUnderThePointer) {
  const Viewport viewport{200, 100};
  const ViewPlace left{.view = left_eye, .width = 100, .height = 100, .scale = 2, .origin_x = 10, .origin_y = 20};
  ViewPlace right = left;
  right.view = right_eye;
  const std::vector<ViewPlace> places = places_in_frame(find_output_mode("left-right"), left, right, viewport);
  const std::optional<PlaceInView> on_right = place_at(places, 100 + 10 + 2 * 7, 20 + 2 * 3);
  ASSERT_TRUE(on_right);
  EXPECT_EQ(on_right->view, right_eye);
  EXPECT_DOUBLE_EQ(on_right->x, 7);
  EXPECT_DOUBLE_EQ(on_right->y, 3);
  const std::vector<ViewPlace> crossed = places_in_frame(find_output_mode("right-left"), left, right, viewport);
  EXPECT_EQ(place_at(crossed, 150, 50)->view, left_eye);
  EXPECT_FALSE(place_at(crossed, 200, 50));
}

TEST(FrameGeometry, OfAnAnaglyphIsTheMiddleViews) {
  const Viewport viewport{100, 100};
  ViewPlace left{.view = left_eye, .width = 100, .height = 100, .origin_x = -6};
  ViewPlace right = left;
  right.view = right_eye;
  right.origin_x = 6;
  const std::vector<ViewPlace> places = places_in_frame(find_output_mode("red-cyan"), left, right, viewport);
  ASSERT_EQ(places.size(), 1u);
  EXPECT_EQ(places.front().view, central_view);
  EXPECT_DOUBLE_EQ(place_at(places, 30, 40)->x, 30);
}

}  // namespace wheatstone::viewer::frame_test
