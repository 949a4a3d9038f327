#include "wheatstone/depth/disparity_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "throws_error.h"

namespace wheatstone::disparity_mapping_test {

TEST(DisparityMapping, IsALineBetweenItsPointsAndLevelBeyondThem) {
  const DisparityMapping mapping{{{0, -4}, {10, -4}, {20, 6}}};
  EXPECT_FLOAT_EQ(mapped_px(mapping, -3), -4);
  EXPECT_FLOAT_EQ(mapped_px(mapping, 5), -4);
  EXPECT_FLOAT_EQ(mapped_px(mapping, 15), 1);
  EXPECT_FLOAT_EQ(mapped_px(mapping, 99), 6);
  EXPECT_FLOAT_EQ(mapped_px({}, 7), 7);
  EXPECT_TRUE(std::isnan(mapped_px(mapping, std::numeric_limits<float>::quiet_NaN())));
}

TEST(DisparityMapping, PutsPlacesWhereTheRegionsHaveThem) {
  const ViewingGeometry viewing{.width_px = 640};
  const std::vector<DepthRegion> regions{{0, -40}, {0.25f, 0}, {1, 60}};
  const DisparityMapping mapping = disparity_mapping(regions, {.farthest_px = 5, .nearest_px = 25}, viewing);
  for (const DepthRegion& region : regions) {
    const float disparity_px = mapped_px(mapping, 25 - region.share * 20);
    EXPECT_NEAR(perceived_depth_mm(viewing, -disparity_px * viewing.pixel_pitch_mm()), region.behind_mm, 0.01);
  }
  EXPECT_EQ(mapped_px(mapping, 20), 0) << "what is to lie on the screen has no disparity";
  expect_error(ErrorKind::wrong_usage, "behind the viewer", [&] {
    disparity_mapping(std::vector<DepthRegion>{{0, -701}, {1, 60}}, {.farthest_px = 5, .nearest_px = 25}, viewing);
  });
}

TEST(DepthRegions, AreReadAsTheyAreWritten) {
  const std::vector<DepthRegion> regions{{0, -80}, {0.4f, 0}, {1, 80.5f}};
  EXPECT_EQ(text_of(regions), "0:-80,0.4:0,1:80.5");
  EXPECT_EQ(parse_depth_regions(text_of(regions), "regions"), regions);
  for (const char* text :
       {"", "0", "0:", "0:1,", "0:1;1:2", "0:1,0:2", "0:5,1:-5", "0:0,1.5:3", "0:nan,1:3", "0:1 ,1:2"})
    expect_error(ErrorKind::wrong_usage, "--it: is '", [text] { parse_depth_regions(text, "--it"); });
}

}  // namespace wheatstone::disparity_mapping_test
