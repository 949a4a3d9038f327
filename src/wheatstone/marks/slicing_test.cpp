#include "wheatstone/marks/slicing.h"

#include <gtest/gtest.h>

#include "throws_error.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/present.h"
#include "wheatstone/painting/two_eyes.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::slicing_test {

const Painting& painting() {
  static const Painting planned = [] {
    const SyntheticStill still = make_synthetic_still({.width = 160, .height = 120, .samples_a_side = 1});
    return plan_painting(still.pictures, still.geometry, style_by_name("oil"));
  }();
  return planned;
}

std::size_t count_in(const Painting& of, std::size_t layer) { return layers_of(of)[layer].strokes.size(); }

Painting at(const char* depth, SliceKeeps keeps = SliceKeeps::back) {
  return sliced(painting(), {.depths = parse_slice_depths(depth, "depth"), .keeps = keeps});
}

TEST(Slicing, WithoutAPlaneShowsLayersUpToTheFinest) {
  EXPECT_EQ(sliced(painting(), {}), painting());
  const Painting coarse = sliced(painting(), {.finest_layer = 1});
  ASSERT_EQ(layers_of(coarse).size(), 2u);
  EXPECT_EQ(layers_of(coarse)[1], layers_of(painting())[1]);
}

TEST(Slicing, BeforeEverythingOrBehindItHidesNothingOrAllOfTheLayer) {
  const std::size_t last = layers_of(painting()).size() - 1;
  EXPECT_EQ(at("0%"), painting());
  EXPECT_EQ(at("100%", SliceKeeps::front), painting());
  EXPECT_EQ(count_in(at("-9999px"), last), 0u);
  EXPECT_EQ(count_in(at("9999px", SliceKeeps::front), last), 0u);
  for (std::size_t layer = 0; layer < last; ++layer)
    EXPECT_EQ(layers_of(at("-9999px"))[layer], layers_of(painting())[layer]);
}

TEST(Slicing, HidesMoreTheFartherThePlaneIs) {
  const std::size_t last = layers_of(painting()).size() - 1;
  std::size_t before = count_in(painting(), last);
  for (const char* depth : {"10%", "25%", "40%", "60%", "80%", "100%"}) {
    const std::size_t count = count_in(at(depth), last);
    EXPECT_LE(count, before) << depth;
    // What one side keeps the other hides, but for strokes in the plane itself.
    EXPECT_GE(count + count_in(at(depth, SliceKeeps::front), last), count_in(painting(), last)) << depth;
    before = count;
  }
  EXPECT_LT(before, count_in(painting(), last) / 10);
}

TEST(Slicing, CutsEachLayerByItsOwnPlane) {
  const std::size_t last = layers_of(painting()).size() - 1;
  const Painting both = at("10%,60%");
  EXPECT_EQ(layers_of(both)[last], layers_of(at("10%"))[last]);
  EXPECT_EQ(layers_of(both)[last - 1],
            layers_of(sliced(painting(), {.finest_layer = static_cast<int>(last) - 1,
                                          .depths = parse_slice_depths("60%", "depth")}))[last - 1]);
}

TEST(Slicing, LeavesNothingBareThatTheUnderpaintingCovers) {
  const std::size_t last = layers_of(painting()).size() - 1;
  for (std::size_t layer = 1; layer <= last; ++layer)
    for (const char* depth : {"20%", "50%", "100%"}) {
      const Painting part =
          sliced(painting(), {.finest_layer = static_cast<int>(layer), .depths = parse_slice_depths(depth, "depth")});
      EXPECT_LE(present(part, for_two_eyes()).worst_bare_share, 0.002) << layer << " " << depth;
    }
}

TEST(Slicing, PlanesAreAShareOfTheWayWhateverTheirUnit) {
  const std::vector<float> shares = shares_of(parse_slice_depths("30%,-9999px,9999px", "depths"), painting());
  EXPECT_EQ(shares, (std::vector<float>{0.3f, 1, 0}));
}

TEST(Slicing, DepthIsAShareOrADisparity) {
  const std::vector<SliceDepth> depths{{0.2f, true}, {-12.5f, false}};
  EXPECT_EQ(parse_slice_depths("20%,-12.5px", "depth"), depths);
  EXPECT_EQ(slice_depths_text(depths), "20%,-12.5px");
  for (const char* wrong : {"", "20", "120%", "-1%", "px", "nan%", "1e9px", "20%%", "20%,", ","})
    expect_error(ErrorKind::wrong_usage, "--slice-depth: is '", [&] { parse_slice_depths(wrong, "--slice-depth"); });
}

}  // namespace wheatstone::slicing_test
