#include <gtest/gtest.h>

#include <opencv2/features2d.hpp>
#include <vector>

#include "wheatstone/matching/binary_descriptors_internal.h"

namespace wheatstone::binary_descriptors_test {

cv::Mat descriptors(int count, std::uint64_t seed) {
  cv::Mat result(count, 32, CV_8U);
  cv::RNG(seed).fill(result, cv::RNG::UNIFORM, 0, 256);
  return result;
}

/// Some bits of a descriptor turned over.
void disturb(cv::Mat descriptor, int bits, cv::RNG& random) {
  for (int i = 0; i < bits; ++i) {
    std::uint8_t& byte = descriptor.at<std::uint8_t>(random.uniform(0, 32));
    byte = static_cast<std::uint8_t>(byte ^ 1 << random.uniform(0, 8));
  }
}

TEST(BinaryDescriptors, AreMatchedAsOpenCvMatchesThem) {
  for (const int count : {1, 3, 8, 61, 300}) {
    const cv::Mat left = descriptors(count, 5);
    cv::Mat right = descriptors(count + 7, 6);
    cv::RNG random(7);
    for (int i = 0; i < count; i += 2) {
      left.row(i).copyTo(right.row(count - i - 1));
      disturb(right.row(count - i - 1), random.uniform(0, 60), random);
    }
    if (count > 8) left.row(2).copyTo(right.row(5));  // nearest is the first of two
    std::vector<cv::DMatch> expected;
    cv::BFMatcher(cv::NORM_HAMMING, true).match(left, right, expected);
    const std::vector<BinaryMatch> found = match_binary_descriptors(left, right);
    ASSERT_EQ(found.size(), expected.size()) << count;
    for (std::size_t i = 0; i < found.size(); ++i) {
      EXPECT_EQ(found[i].left, expected[i].queryIdx);
      EXPECT_EQ(found[i].right, expected[i].trainIdx);
      EXPECT_EQ(found[i].distance_bits, static_cast<int>(expected[i].distance));
    }
  }
}

TEST(BinaryDescriptors, OfAnEmptySetAreNotMatched) {
  EXPECT_TRUE(match_binary_descriptors({}, descriptors(3, 1)).empty());
  EXPECT_TRUE(match_binary_descriptors(descriptors(3, 1), {}).empty());
}

}  // namespace wheatstone::binary_descriptors_test
