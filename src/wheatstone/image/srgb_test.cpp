#include "wheatstone/image/srgb.h"

#include <gtest/gtest.h>

#include <cmath>

namespace wheatstone {
namespace {

TEST(Srgb, EveryCodeComesBack) {
  for (int code = 0; code < 256; ++code)
    EXPECT_EQ(srgb_from_linear(linear_from_srgb(static_cast<std::uint8_t>(code))), code);
}

TEST(Srgb, IsTheStandardsCurve) {
  EXPECT_EQ(linear_from_srgb(0), 0);
  EXPECT_EQ(linear_from_srgb(255), 1);
  EXPECT_NEAR(linear_from_srgb(128), 0.21586, 1e-5);
  EXPECT_EQ(srgb_from_linear(0.5f), 188);
  EXPECT_EQ(srgb_from_linear(-1), 0);
  EXPECT_EQ(srgb_from_linear(7), 255);
}

}  // namespace
}  // namespace wheatstone
