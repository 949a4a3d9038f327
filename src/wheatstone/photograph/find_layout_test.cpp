#include "wheatstone/photograph/find_layout.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "scenes/test_photographs.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/not_a_pair.h"

namespace wheatstone::find_layout_test {

using enum StereoLayout;

TEST(LayoutFromName, IsSaidByItsLastWords) {
  const auto wide = [](const char* name) { return layout_from_name(name, 2400, 800); };
  EXPECT_EQ(wide("tree_sbs.jpg"), left_right);
  EXPECT_EQ(wide("tree-SBS.jpg"), left_right);
  EXPECT_EQ(wide("tree_LRF_Full_SBS.png"), left_right);
  EXPECT_EQ(wide("tree_half_sbs.png"), left_right_half);
  EXPECT_EQ(wide("tree.HSBS.png"), left_right_half);
  EXPECT_EQ(wide("tree_LR.png"), left_right);
  EXPECT_EQ(wide("tree_LR_180.png"), left_right);
  EXPECT_EQ(wide("tree_rl.png"), right_left);
  EXPECT_EQ(wide("tree_crosseyed.png"), right_left);
  EXPECT_EQ(wide("tree_tb_full.png"), top_bottom);
  EXPECT_EQ(wide("tree_3D_ou_half.png"), top_bottom_half);
  EXPECT_EQ(wide("tree bt full.png"), bottom_top);
  EXPECT_EQ(wide("sbs.png"), left_right);
}

TEST(LayoutFromName, IsNotSaidByOtherWords) {
  for (const char* name : {"tree.jpg", "ou_est_le_chat.jpg", "sbs_of_the_tree.jpg", "lr_1.jpg", "album.png", "half.png",
                           "", "full_half.png", "crabs.jpg"})
    EXPECT_EQ(layout_from_name(name, 2400, 800), std::nullopt) << name;
}

TEST(LayoutFromName, LeavesTheSizeToThePicturesShape) {
  EXPECT_EQ(layout_from_name("tree_lr.png", 1920, 1080), left_right_half);
  EXPECT_EQ(layout_from_name("tree_lr.png", 3840, 1080), left_right);
  EXPECT_EQ(layout_from_name("tree_lr_full.png", 1920, 1080), left_right);
  EXPECT_EQ(layout_from_name("tree_tb.png", 1920, 1080), top_bottom_half);
  EXPECT_EQ(layout_from_name("tree_tb.png", 1920, 2160), top_bottom);
}

const std::vector<std::pair<std::string, StereoPair>>& pairs() {
  static const auto made = [] {
    std::vector<std::pair<std::string, StereoPair>> all;
    all.emplace_back("still", still_for_test());
    for (const char* name : {"teddy", "motorcycle"})
      if (auto pair = shared_pair(name)) all.emplace_back(name, std::move(*pair));
    return all;
  }();
  return made;
}

Image<Rgb8> resized(const Image<Rgb8>& picture, int width, int height) {
  Image<Rgb8> other(width, height);
  cv::Mat target = as_mat(other);
  cv::resize(as_mat(picture), target, target.size(), 0, 0, cv::INTER_AREA);
  return other;
}

void expect_seen(const StereoPair& pair) {
  EXPECT_GE(block_agreement(pair.left, pair.right, 0).share, 0.5);
  EXPECT_EQ(layout_from_halves(joined(pair.left, pair.right, true)), left_right);
  EXPECT_EQ(layout_from_halves(joined(pair.left, pair.right, false)), top_bottom);
  EXPECT_EQ(layout_from_halves(resized(joined(pair.left, pair.right, true), 960, 540)), left_right_half);
  EXPECT_EQ(layout_from_halves(resized(joined(pair.left, pair.right, false), 960, 540)), top_bottom_half);
}

TEST(LayoutFromHalves, IsSeenInPairs) {
  for (const auto& [name, pair] : pairs()) {
    SCOPED_TRACE(name);
    expect_seen(pair);
  }
}

TEST(LayoutFromHalvesLong, IsSeenInALargePair) {
  const auto aloe = shared_pair("aloe");
  if (!aloe) GTEST_SKIP() << "no shared photographs";
  expect_seen(*aloe);
  EXPECT_EQ(layout_from_halves(aloe->left), std::nullopt);
}

// A first look at a JPEG decodes an eighth of its size.
TEST(LayoutFromHalves, IsSeenInSmallCopies) {
  constexpr int width = 400;
  const auto small = [](const Image<Rgb8>& picture) {
    return resized(picture, width, width * picture.height() / picture.width());
  };
  for (const auto& [name, pair] : pairs()) {
    SCOPED_TRACE(name);
    EXPECT_EQ(arrangement_of_halves(small(joined(pair.left, pair.right, true))), Arrangement::side_by_side);
    EXPECT_EQ(arrangement_of_halves(small(joined(pair.left, pair.right, false))), Arrangement::over_under);
    EXPECT_EQ(arrangement_of_halves(small(pair.left)), std::nullopt);
    EXPECT_EQ(arrangement_of_halves(small(pair.right)), std::nullopt);
  }
}

TEST(LayoutFromHalves, IsCrossEyedWhereThePictureSaysSo) {
  const StereoPair pair = still_for_test();
  EXPECT_EQ(layout_from_halves(joined(pair.right, pair.left, true)), right_left);
  EXPECT_EQ(layout_from_halves(joined(pair.right, pair.left, false)), bottom_top);
}

TEST(LayoutFromHalves, IsNotSeenInOrdinaryPictures) {
  for (const auto& [name, pair] : pairs()) {
    SCOPED_TRACE(name);
    EXPECT_EQ(layout_from_halves(pair.left), std::nullopt);
    EXPECT_EQ(layout_from_halves(resized(pair.right, 640, 360)), std::nullopt);
  }
  EXPECT_EQ(layout_from_halves(joined(still_for_test(480, 360, 1).left, Image<Rgb8>(480, 360, {3, 4, 5}), true)),
            std::nullopt);
  EXPECT_EQ(layout_from_halves(Image<Rgb8>(400, 300, {9, 9, 9})), std::nullopt);
  EXPECT_EQ(layout_from_halves(Image<Rgb8>(1, 1)), std::nullopt);
  const auto teddy = shared_pair("teddy"), motorcycle = shared_pair("motorcycle");
  if (teddy && motorcycle) {
    EXPECT_EQ(layout_from_halves(joined(resized(teddy->left, 450, 375), resized(motorcycle->left, 450, 375), true)),
              std::nullopt);
  }
}

// A wallpaper's halves are alike in every way: what repeats itself tells nothing.
TEST(LayoutFromHalves, IsNotSeenInAPattern) {
  Image<Rgb8> pattern(600, 400);
  for (int y = 0; y < 400; ++y) {
    for (int x = 0; x < 600; ++x) {
      const auto level = static_cast<std::uint8_t>((x / 10 + y / 10) % 2 == 0 ? 40 : 210);
      pattern(x, y) = {level, level, level};
    }
  }
  EXPECT_EQ(layout_from_halves(pattern), std::nullopt);
}

}  // namespace wheatstone::find_layout_test
