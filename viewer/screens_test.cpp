#include "screens.h"

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <vector>

#include "session.h"
#include "stage.h"

namespace wheatstone::viewer::screens_test {

const std::array screens{Screen{"DELL U2720Q", 3840, 2160}, Screen{"LKG Looking Glass Portrait", 1536, 2048},
                         Screen{"HDMI-2", 1920, 1200}};

Session session_of(const char* display, const char* mode) {
  Session session;
  session.state.display = display;
  session.state.mode = mode;
  return session;
}

TEST(ScreenToFill, IsTheOneThatWasAskedForWhereItIsThere) {
  Session session = session_of("looking-glass-portrait", "quilt");
  session.screen = 3;
  EXPECT_EQ(screen_to_fill(session, screens), 3);
  session.screen = 4;
  EXPECT_EQ(screen_to_fill(session, screens), 2);
}

TEST(ScreenToFill, IsTheOneThatIsCalledAsTheDisplay) {
  EXPECT_EQ(screen_to_fill(session_of("looking-glass-portrait", "quilt"), screens), 2);
  EXPECT_EQ(screen_to_fill(session_of("looking-glass-portrait", "red-cyan"), screens), 2);
  EXPECT_EQ(screen_to_fill(session_of("looking-glass-go", "quilt"), screens), 0);
}

TEST(ScreenToFill, IsTheOneOfTheLensesSizeWhereAllViewsAreShown) {
  const std::optional<PictureSize> size = screen_size_of(session_of("philips-9", "lenticular").state);
  ASSERT_TRUE(size);
  std::vector<Screen> with_lenses(screens.begin(), screens.end());
  with_lenses.push_back({"HDMI-3", size->width, size->height});
  EXPECT_EQ(screen_to_fill(session_of("philips-9", "lenticular"), with_lenses), 4);
  EXPECT_EQ(screen_to_fill(session_of("philips-9", "left-right"), with_lenses), 0) << "both eyes fit on any screen";
}

TEST(UnpluggedScreen, LosesAWindowOfWhichNothingIsOnAnother) {
  const std::array left{DesktopArea{0, 0, 1920, 1080}};
  EXPECT_TRUE(is_lost({1920, 0, 1536, 2048}, left));
  EXPECT_TRUE(is_lost({-600, 100, 600, 400}, left));
  EXPECT_FALSE(is_lost({1900, 100, 600, 400}, left));
}

TEST(UnpluggedScreen, HasItsWindowBroughtToTheMiddleOfTheRest) {
  const DesktopArea available{0, 40, 1920, 1040};
  EXPECT_EQ(brought_to(available, {2000, 100, 600, 400}), (DesktopArea{660, 360, 600, 400}));
  EXPECT_EQ(brought_to(available, {2000, 100, 1600, 1400}), (DesktopArea{160, 40, 1600, 1040}));
}

TEST(RecentFiles, AreTheNewestFirstNothingTwiceAndNotTooMany) {
  const std::filesystem::path here = std::filesystem::current_path();
  const std::vector<Item> opened{{"a.wst"}, {"left.png", "right.png"}, {"folder/../a.wst"}};
  std::vector<Item> before{{here / "b.wst"}, {here / "left.png", here / "right.png"}};
  const std::vector<Item> recent = recent_items(opened, before);
  EXPECT_EQ(recent, (std::vector<Item>{{here / "a.wst"}, {here / "left.png", here / "right.png"}, {here / "b.wst"}}));
  for (int file = 0; file < 20; ++file) before.push_back({"/old/" + std::to_string(file)});
  EXPECT_EQ(recent_items(opened, before).size(), 10u);
}

}  // namespace wheatstone::viewer::screens_test
