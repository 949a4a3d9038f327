#include "wheatstone/app/detail_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "shared_data.h"
#include "throws_error.h"
#include "wheatstone/marks/style.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/pictures/find_faces.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/view.h"
#include "wheatstone/synthetic/synthetic_still.h"

namespace wheatstone::detail_map_test {

Painting flat_painting(const Image<Rgb8>& picture, ImageView<const std::uint8_t> detail = {}) {
  const StereoGeometry flat{.left_disparity = Image<float>(picture.width(), picture.height())};
  return plan_painting({picture, {}}, flat, style_by_name("oil"), {}, widest_views, detail);
}

/// Strokes that begin in columns [left, right).
std::size_t strokes_between(const Painting& painting, float left, float right) {
  std::size_t count = 0;
  for (const Layer& layer : std::get<StrokePainting>(painting.marks).layers)
    for (const Stroke& stroke : layer.strokes) {
      const float x = layer.points_of(stroke).front().x;
      count += x >= left && x < right;
    }
  return count;
}

TEST(DetailMap, SpendsStrokesWhereItIsWhiteAndSavesThemWhereItIsBlack) {
  const Image<Rgb8> picture = make_synthetic_still({.width = 320, .height = 240, .samples_a_side = 1}).pictures.left;
  Image<std::uint8_t> map(2, 1);  // stretched over the picture, soft between
  map(0, 0) = 178;
  map(1, 0) = 78;
  const Painting even = flat_painting(picture), mapped = flat_painting(picture, map);
  EXPECT_GT(strokes_between(mapped, 0, 80), strokes_between(even, 0, 80) * 3 / 2);
  EXPECT_LT(strokes_between(mapped, 240, 320), strokes_between(even, 240, 320) * 2 / 3);
}

TEST(DetailMap, OfOneGreyIsNoMap) {
  const Image<Rgb8> picture = make_synthetic_still({.width = 160, .height = 120, .samples_a_side = 1}).pictures.left;
  EXPECT_EQ(flat_painting(picture, Image<std::uint8_t>(4, 3, even_detail)), flat_painting(picture));
}

TEST(DetailMap, IsRefusedForStrokesThatAreNotFitted) {
  const SyntheticStill still = make_synthetic_still({.width = 64, .height = 48, .samples_a_side = 1});
  const Image<std::uint8_t> map(8, 6, 255);
  const auto plan = [&](const Style& style) {
    plan_painting(still.pictures, still.geometry, style, {}, widest_views, map);
  };
  expect_error(ErrorKind::wrong_usage, "impressionist: takes no detail map",
               [&] { plan(style_by_name("impressionist")); });
  Style apart = style_by_name("oil");
  apart.propagation = Propagation::independent;
  expect_error(ErrorKind::wrong_usage, "propagation = strokes", [&] { plan(apart); });
}

TEST(DetailMap, RaisesFaces) {
  const std::filesystem::path portrait = shared_data() / "paintings" / "P2.jpg";
  if (!std::filesystem::exists(portrait)) GTEST_SKIP() << "shared data is missing";
  const Image<Rgb8> picture = read_image(portrait);
  if (!find_faces(picture)) GTEST_SKIP() << "opencv-data is not installed";
  const Image<std::uint8_t> detail = detail_of_faces(picture);
  ASSERT_FALSE(detail.empty());
  EXPECT_EQ(detail(0, 0), even_detail);
  EXPECT_GT(*std::ranges::max_element(detail.pixels()), even_detail + 10);
}

}  // namespace wheatstone::detail_map_test
