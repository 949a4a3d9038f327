#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include "wheatstone/matching/nearest_descriptors_internal.h"

namespace wheatstone::nearest_descriptors_test {

constexpr int columns = 128;

/// Whole numbers as SIFT's are; of few kinds, so that some are equally near.
cv::Mat descriptors(int count, unsigned seed) {
  std::mt19937 random(seed);
  cv::Mat rows(count, columns, CV_32F);
  for (int y = 0; y < count; ++y) {
    const auto kind = static_cast<float>(random() % 40);
    for (int x = 0; x < columns; ++x) rows.at<float>(y, x) = x < 4 ? static_cast<float>(random() % 2) : kind;
  }
  return rows;
}

/// One after the other, sorted.
std::vector<NearestDescriptors> slowly(const cv::Mat& from, const cv::Mat& into) {
  std::vector<NearestDescriptors> result(from.rows);
  for (int y = 0; y < from.rows; ++y) {
    std::vector<double> distances(into.rows);
    for (int i = 0; i < into.rows; ++i) distances[i] = cv::norm(from.row(y), into.row(i), cv::NORM_L2SQR);
    std::vector<int> order(into.rows);
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, {}, [&](int i) { return distances[i]; });
    for (int k = 0; k < std::min(NearestDescriptors::count, into.rows); ++k) {
      result[y].row[k] = order[k];
      result[y].squared_distance[k] = static_cast<float>(distances[order[k]]);
    }
  }
  return result;
}

void expect_equal(const std::vector<NearestDescriptors>& found, const std::vector<NearestDescriptors>& expected) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    ASSERT_EQ(found[i].row, expected[i].row) << i;
    ASSERT_EQ(found[i].squared_distance, expected[i].squared_distance) << i;
  }
}

TEST(NearestDescriptors, AreThoseOfTheSlowSearchWithEveryInstructionSet) {
  const cv::Mat from = descriptors(151, 1), into = descriptors(203, 2);
  const auto expected = slowly(from, into);
  for (const std::int64_t target : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(target);
    SCOPED_TRACE(hwy::TargetName(target));
    expect_equal(nearest_descriptors(from, into), expected);
  }
  hwy::SetSupportedTargetsForTest(0);
}

TEST(NearestDescriptors, AreFewerWhereThereAreNoMore) {
  const cv::Mat from = descriptors(5, 3);
  for (const int count : {1, 2}) {
    const auto found = nearest_descriptors(from, descriptors(count, 4));
    expect_equal(found, slowly(from, descriptors(count, 4)));
    EXPECT_EQ(found[0].row[2], -1);
  }
  EXPECT_TRUE(nearest_descriptors(cv::Mat(0, columns, CV_32F), from).empty());
}

}  // namespace wheatstone::nearest_descriptors_test
