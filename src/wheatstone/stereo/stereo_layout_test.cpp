#include "wheatstone/stereo/stereo_layout.h"

#include <gtest/gtest.h>

#include <set>
#include <sstream>
#include <string>

#include "throws_error.h"

namespace wheatstone::stereo_layout_test {

TEST(StereoLayout, IsKnownByItsNamesAndAliases) {
  for (const LayoutTraits& traits : stereo_layouts()) {
    EXPECT_EQ(find_stereo_layout(traits.name), traits.layout);
    EXPECT_EQ(find_stereo_layout(traits.ffmpeg), traits.layout);
    EXPECT_EQ(traits_of(traits.layout).layout, traits.layout) << traits.name << " stands in the wrong line";
  }
  EXPECT_EQ(find_stereo_layout("sbs"), StereoLayout::left_right);
  EXPECT_EQ(find_stereo_layout("sbs-half"), StereoLayout::left_right_half);
  EXPECT_EQ(find_stereo_layout("side-by-side"), StereoLayout::left_right);
  EXPECT_EQ(find_stereo_layout("cross-eyed"), StereoLayout::right_left);
  EXPECT_EQ(find_stereo_layout("tb"), StereoLayout::top_bottom);
  EXPECT_EQ(find_stereo_layout("tb-half"), StereoLayout::top_bottom_half);
  EXPECT_EQ(find_stereo_layout("ab2r"), StereoLayout::bottom_top_half);
}

TEST(StereoLayout, NoTwoHaveANameInCommon) {
  std::set<std::string> seen;
  const auto take = [&](std::string_view words) {
    std::istringstream each{std::string(words)};
    for (std::string word; each >> word;) EXPECT_TRUE(seen.insert(word).second) << word;
  };
  for (const LayoutTraits& traits : stereo_layouts()) {
    take(traits.name);
    take(traits.ffmpeg);
    take(traits.aliases);
    take(traits.full_aliases);
  }
}

TEST(StereoLayout, OfNoNameIsNone) {
  for (const char* name : {"anaglyph", "card", "checkers", "", "lr rl"})
    EXPECT_EQ(find_stereo_layout(name), std::nullopt) << name;
}

TEST(StereoLayout, SwapsAndSqueezesWithoutChangingTheRest) {
  for (const LayoutTraits& traits : stereo_layouts()) {
    const StereoLayout layout = traits.layout;
    if (layout == StereoLayout::mono) continue;
    EXPECT_NE(is_left_first(with_eyes_swapped(layout)), is_left_first(layout));
    EXPECT_EQ(with_eyes_swapped(with_eyes_swapped(layout)), layout);
    EXPECT_EQ(with_half_size(layout, is_half_size(layout)), layout);
    EXPECT_EQ(traits_of(with_eyes_swapped(layout)).arrangement, traits.arrangement);
    EXPECT_TRUE(!is_side_by_side(layout) || is_half_size(with_half_size(layout, true)));
  }
}

}  // namespace wheatstone::stereo_layout_test
