#include "wheatstone/image/cielab_internal.h"

#include <gtest/gtest.h>

namespace wheatstone {
namespace {

TEST(Cielab, IsThatOfKnownColours) {
  struct Known {
    Rgb8 colour;
    Cielab value;
  };
  // Of sRGB's corners, as colour tables have them.
  for (const auto& [colour, value] :
       {Known{{0, 0, 0}, {0, 0, 0}}, Known{{255, 255, 255}, {100, 0, 0}}, Known{{255, 0, 0}, {53.24f, 80.09f, 67.20f}},
        Known{{0, 255, 0}, {87.73f, -86.18f, 83.18f}}, Known{{0, 0, 255}, {32.30f, 79.19f, -107.86f}},
        Known{{119, 119, 119}, {50.03f, 0, 0}}, Known{{5, 5, 5}, {1.37f, 0, 0}}}) {
    const Cielab found = cielab_of(colour);
    EXPECT_NEAR(found.lightness, value.lightness, 0.05f);
    EXPECT_NEAR(found.a, value.a, 0.1f);
    EXPECT_NEAR(found.b, value.b, 0.1f);
  }
}

}  // namespace
}  // namespace wheatstone
