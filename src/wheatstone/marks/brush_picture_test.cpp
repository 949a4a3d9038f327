#include "wheatstone/marks/brush_picture.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "temporary_folder.h"
#include "throws_error.h"
#include "wheatstone/painting/read_brush.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone {
namespace {

TEST(BrushPicture, EveryBuiltInBrushCoversSomeAndLeavesSomeBare) {
  for (const std::string_view name : brush_names()) {
    const BrushPicture brush = read_brush(std::string(name));
    ASSERT_EQ(brush.cover().size(), std::size_t{BrushPicture::length} * BrushPicture::width) << name;
    const double sum = std::accumulate(brush.cover().begin(), brush.cover().end(), 0.);
    const double share = sum / (255. * static_cast<double>(brush.cover().size()));
    EXPECT_GT(share, 0.4) << name;
    EXPECT_LT(share, 0.95) << name;
  }
  EXPECT_TRUE(read_brush("none").empty());
}

TEST(BrushPicture, APictureOfAnySizeIsBroughtToTheBrushs) {
  const TemporaryFolder folder;
  Image<Rgb8> picture(512, 32);
  for (int y = 0; y < picture.height(); ++y)
    for (int x = 0; x < picture.width(); ++x)
      if (x >= 256 && y < 16) picture(x, y) = {255, 255, 255};
  write_image(folder / "brush.png", picture);
  const BrushPicture brush = read_brush(folder / "brush.png");
  EXPECT_EQ(brush.name, folder / "brush.png");
  for (int y = 0; y < BrushPicture::width; ++y)
    for (int x = 0; x < BrushPicture::length; ++x)
      ASSERT_EQ(brush.cover()[static_cast<std::size_t>(y * BrushPicture::length + x)], x >= 128 && y < 32 ? 255 : 0);
}

TEST(BrushPicture, EachLevelIsTheMeanOfTheFinerOne) {
  const BrushPicture brush = read_brush("charcoal");
  for (std::size_t l = 1; l < BrushPicture::sizes.size(); ++l) {
    const auto mean = [&](const BrushPicture::Level& level) {
      const auto begin = brush.levels.begin() + static_cast<std::ptrdiff_t>(level.first);
      const int pixels = level.columns * level.rows;
      return std::accumulate(begin, begin + pixels, 0.) / pixels;
    };
    EXPECT_NEAR(mean(BrushPicture::sizes[l]), mean(BrushPicture::sizes[l - 1]), 0.5);
  }
  EXPECT_EQ(brush_level(40), 0);
  EXPECT_EQ(brush_level(8), 2);
  EXPECT_EQ(brush_level(0.5f), 4);
}

TEST(BrushPicture, WhatIsNoBrushIsRefused) {
  const TemporaryFolder folder;
  expect_error(ErrorKind::wrong_usage, "expected none, round, flat", [] { read_brush("sponge"); });
  expect_error(ErrorKind::bad_input, "missing.png", [&] { read_brush(folder / "missing.png"); });
  write_image(folder / "black.png", Image<Rgb8>(8, 8));
  expect_error(ErrorKind::bad_input, "is black", [&] { read_brush(folder / "black.png"); });
}

TEST(BrushPicture, AStyleFileNamesIt) {
  Style style = style_by_name("oil");
  apply_toml("brush = \"fan\"", "mine.toml", style);
  EXPECT_EQ(style.brush.picture, read_brush("fan"));
  EXPECT_NE(style_to_toml(style).find("brush = \"fan\""), std::string::npos);
}

}  // namespace
}  // namespace wheatstone
