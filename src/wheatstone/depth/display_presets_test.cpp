// Displays by name.

#include "wheatstone/depth/display_presets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "throws_error.h"

namespace wheatstone::display_presets_test {

TEST(DisplayPresets, AreFoundByNameAndSayTheNamesOtherwise) {
  EXPECT_EQ(find_display("looking-glass-go").views, 66);
  for (const DisplayPreset& display : display_presets())
    expect_error(ErrorKind::wrong_usage, std::string(display.name), [] { find_display("moon"); });
}

TEST(DisplayPresets, AreConsistent) {
  std::set<std::string_view> names;
  for (const DisplayPreset& display : display_presets()) {
    SCOPED_TRACE(display.name);
    EXPECT_TRUE(names.insert(display.name).second);
    if (display.quilt_columns > 0) {
      EXPECT_EQ(display.views, display.quilt_columns * display.quilt_rows);
      EXPECT_EQ(display.view_width_px, display.quilt_width_px / display.quilt_columns);
      EXPECT_EQ(display.view_height_px, display.quilt_height_px / display.quilt_rows);
    } else {
      EXPECT_NEAR(static_cast<float>(display.view_width_px) / static_cast<float>(display.view_height_px),
                  display.aspect, 0.01f);
    }
    EXPECT_GE(display.views, 2);
    EXPECT_GT(span_of(display), 0);
  }
}

TEST(DisplayPresets, GiveTheThesissPlanes) {
  // Hassaine 2010, sec. 5.6, says "about 60" and "about 36" for "standard desktop viewing conditions".
  EXPECT_NEAR(stereoscopic_resolution(viewing_of(find_display("desk-stereo")), 100, 100), 60, 0.1);
  EXPECT_NEAR(stereoscopic_resolution(viewing_of(find_display("nine-view")), 100, 100), 36, 0.1);
}

TEST(DisplayPresets, TwoViewsAreTheEyesAndConesAreAsWideAsTheyAreWhereTheViewerIs) {
  EXPECT_EQ(span_of(find_display("desk-stereo")), right_eye - left_eye);
  // 40 degrees, 450 mm away.
  EXPECT_NEAR(span_of(find_display("looking-glass-portrait")), 2 * 450 * std::tan(20 * M_PI / 180) / 65, 1e-4);
  // Nine windows of about half an eye separation.
  EXPECT_NEAR(span_of(find_display("nine-view")) / 8, 0.5, 0.1);
}

}  // namespace wheatstone::display_presets_test
