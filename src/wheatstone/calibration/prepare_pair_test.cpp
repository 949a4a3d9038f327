#include "wheatstone/calibration/prepare_pair.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "scenes/test_photographs.h"
#include "throws_error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::prepare_pair_test {

const StereoPair& still() {
  static const StereoPair pair = still_for_test();
  return pair;
}

/// The still's right picture, taken through `change`.
template <class Change>
StereoPair with_right(Change change) {
  StereoPair pair = still();
  cv::Mat changed;
  change(as_mat(still().right), changed);
  changed.copyTo(as_mat(pair.right));
  return pair;
}

StereoPair lowered(int rows) {
  return with_right([&](const cv::Mat& from, cv::Mat& to) {
    const cv::Mat move = (cv::Mat_<double>(2, 3) << 1, 0, 0, 0, 1, rows);
    cv::warpAffine(from, to, move, from.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  });
}

StereoPair turned(double degrees) {
  return with_right([&](const cv::Mat& from, cv::Mat& to) {
    const cv::Point2f middle(static_cast<float>(from.cols) / 2, static_cast<float>(from.rows) / 2);
    cv::warpAffine(from, to, cv::getRotationMatrix2D(middle, degrees, 1), from.size(), cv::INTER_LINEAR,
                   cv::BORDER_REPLICATE);
  });
}

constexpr PreparePairOptions as_they_are{.rectify = RectifyPolicy::never};

TEST(PreparePair, LeavesARectifiedPairAsItIs) {
  const PreparedPair prepared = prepare_pair(still());
  EXPECT_EQ(prepared.pictures.right, still().right);
  EXPECT_FALSE(prepared.rectification);
  EXPECT_EQ(rectified_note(prepared), "");
  EXPECT_GE(prepared.compared_features, 100);
  EXPECT_LT(prepared.rows.value().median_px, 0.3);
  EXPECT_EQ(row_warning(prepared), "");
}

TEST(PreparePair, FindsPhotographsRectifiedThatAre) {
  for (const char* name : {"teddy", "motorcycle", "aloe"}) {
    const auto pair = shared_pair(name);
    if (!pair) GTEST_SKIP() << "no shared data";
    const PreparedPair prepared = prepare_pair(*pair);
    EXPECT_LT(prepared.rows.value().median_px, 0.25) << name;
    EXPECT_FALSE(prepared.rectification) << name;
    EXPECT_EQ(row_warning(prepared), "") << name;
  }
}

// Features are found no better in a larger picture of the same scene.
TEST(PreparePair, LeavesAnEnlargedRectifiedPairAsItIs) {
  const auto pair = shared_pair("motorcycle");
  if (!pair) GTEST_SKIP() << "no shared data";
  const auto enlarged = [](const Image<Rgb8>& picture) {
    Image<Rgb8> larger(6000, 6000 * picture.height() / picture.width());
    cv::Mat to = as_mat(larger);
    cv::resize(as_mat(picture), to, to.size(), 0, 0, cv::INTER_CUBIC);
    return larger;
  };
  const PreparedPair prepared = prepare_pair({enlarged(pair->left), enlarged(pair->right)});
  EXPECT_FALSE(prepared.rectification);
  EXPECT_EQ(row_warning(prepared), "");
}

TEST(PreparePair, TellsByHowManyRowsAPairIsOff) {
  for (const int rows : {2, 12}) {
    const PreparedPair prepared = prepare_pair(lowered(rows), as_they_are);
    EXPECT_NEAR(prepared.rows.value().median_px, rows, 0.3);
    EXPECT_THAT(row_warning(prepared), testing::HasSubstr("wheatstone rectify"));
    EXPECT_THAT(row_warning(prepared), testing::HasSubstr(std::to_string(rows) + ".0 pixels"));
  }
  const PreparedPair prepared = prepare_pair(turned(3), as_they_are);
  EXPECT_GT(prepared.rows.value().median_px, 3);
  EXPECT_NE(row_warning(prepared), "");
}

TEST(PreparePair, RectifiesWhereThatIsWanted) {
  const PreparedPair prepared = prepare_pair(turned(3), {.rectify = RectifyPolicy::always});
  EXPECT_TRUE(prepared.rectification);
  EXPECT_THAT(rectified_note(prepared), testing::HasSubstr("its rows differed by"));
  EXPECT_LT(prepared.rows.value().median_px, 0.5);
  EXPECT_EQ(row_warning(prepared), "");
  EXPECT_LT(prepare_pair(prepared.pictures).rows.value().median_px, 0.5) << "measured anew";
}

TEST(PreparePair, RectifiesByItselfWhereRowsDiffer) {
  for (const int rows : {2, 12}) {
    const PreparedPair prepared = prepare_pair(lowered(rows));
    ASSERT_TRUE(prepared.rectification) << rows;
    EXPECT_NEAR(prepared.photographed_rows.value().median_px, rows, 0.3);
    EXPECT_LT(prepared.rows.value().median_px, 0.3);
    EXPECT_EQ(row_warning(prepared), "");
  }
  // A shear leaves the median below a pixel, but not the rows at the sides.
  const PreparedPair sheared = prepare_pair(with_right([](const cv::Mat& from, cv::Mat& to) {
    const cv::Mat slant = (cv::Mat_<double>(2, 3) << 1, 0, 0, 0.0001, 1, 0.9);
    cv::warpAffine(from, to, slant, from.size(), cv::INTER_LINEAR, cv::BORDER_REPLICATE);
  }));
  EXPECT_FALSE(sheared.rectification) << "0.9 px everywhere is tolerated";
}

TEST(PreparePair, KeepsTheSizeWhereThatIsWanted) {
  const PreparedPair prepared = prepare_pair(turned(3), {.keep_size = true});
  ASSERT_TRUE(prepared.rectification);
  EXPECT_TRUE(same_size(prepared.pictures.left, still().left));
  EXPECT_LT(prepare_pair(prepared.pictures, as_they_are).rows.value().median_px, 0.5) << "measured anew";
}

TEST(PreparePair, KeepsPicturesThatCannotBeRectifiedAndSaysWhy) {
  // A part with enough features to see that its rows differ, and too few to estimate cameras from.
  const StereoPair low = lowered(6);
  StereoPair part{Image<Rgb8>(110, 80), Image<Rgb8>(110, 80)};
  for (int y = 0; y < 80; ++y)
    for (int x = 0; x < 110; ++x) {
      part.left(x, y) = low.left(x + 180, y + 160);
      part.right(x, y) = low.right(x + 165, y + 160);
    }
  const PreparedPair prepared = prepare_pair(part);
  ASSERT_TRUE(prepared.rows.has_value());
  EXPECT_FALSE(prepared.rectification);
  EXPECT_FALSE(prepared.why_not_rectified.empty());
  EXPECT_THAT(row_warning(prepared), testing::HasSubstr(prepared.why_not_rectified));
}

TEST(PreparePair, RefusesAPictureThatIsTurnedOrMirrored) {
  const auto refuses = [](const StereoPair& pair, const std::string& why) {
    for (const RectifyPolicy policy : {RectifyPolicy::never, RectifyPolicy::always})
      expect_error(ErrorKind::bad_input, why, [&] { prepare_pair(pair, {.rectify = policy}); });
  };
  const auto flipped = [](int code) {
    return with_right([code](const cv::Mat& from, cv::Mat& to) { cv::flip(from, to, code); });
  };
  refuses(flipped(-1), "the right picture is upside down relative to the left one");
  refuses(flipped(0), "upside down and mirrored");
  refuses(flipped(1), "the right picture is mirrored relative to the left one");
  refuses(turned(90), "turned by 90 degrees");
}

TEST(PreparePair, RefusesABlankPicture) {
  StereoPair pair = still();
  pair.right = Image<Rgb8>(pair.left.width(), pair.left.height(), {0, 0, 0});
  expect_error(ErrorKind::bad_input, "the right picture is blank", [&] { prepare_pair(pair); });
  std::swap(pair.left, pair.right);
  expect_error(ErrorKind::bad_input, "the left picture is blank", [&] { prepare_pair(pair); });
  pair.right = pair.left;
  expect_error(ErrorKind::bad_input, "both blank", [&] { prepare_pair(pair); });
}

TEST(PreparePair, RefusesTwoScenesAndTwoSizes) {
  const StereoPair other = still_for_test(480, 360, 9);
  StereoPair pair{still().left, other.right};
  // Two seeds put the same things on the table; their rows in another order are another scene.
  for (int y = 0; y < 360; ++y)
    for (int x = 0; x < 480; ++x) pair.right(x, y) = other.right((3 * x) % 480, 359 - y);
  expect_error(ErrorKind::bad_input, "show different scenes", [&] { prepare_pair(pair); });
  expect_error(ErrorKind::bad_input, "expected the left one's", [&] {
    prepare_pair({still().left, Image<Rgb8>(10, 10)});
  });
}

TEST(PreparePair, DoesNotJudgeWhereThereIsTooLittleToGoBy) {
  StereoPair pair{Image<Rgb8>(64, 48, {40, 40, 40}), Image<Rgb8>(64, 48, {40, 40, 40})};
  for (int y = 10; y < 30; ++y)
    for (int x = 20; x < 40; ++x) pair.left(x, y) = pair.right(x - 4, y) = {200, 180, 90};
  const PreparedPair prepared = prepare_pair(pair);
  EXPECT_FALSE(prepared.rows.has_value());
  EXPECT_EQ(row_warning(prepared), "");
}

}  // namespace wheatstone::prepare_pair_test
