#include "wheatstone/particles/appearance.h"

#include <gtest/gtest.h>

#include <cmath>

#include "throws_error.h"

namespace wheatstone::appearance_test {

CloudStatistics statistics_of(const Cloud& cloud) {
  CloudStatistics statistics;
  statistics.add(cloud);
  return statistics;
}

Cloud line(int count) {
  Cloud cloud;
  for (int i = 0; i < count; ++i) {
    cloud.x.push_back(static_cast<float>(i));
    cloud.y.push_back(0);
    cloud.z.push_back(0);
    cloud.density.push_back(std::exp2(static_cast<float>(i) / 10));
    cloud.temperature.push_back(100 * std::exp2(static_cast<float>(i) / 20));
  }
  return cloud;
}

TEST(LogHistogram, FindsPercentilesToWithinAStep) {
  LogHistogram histogram;
  std::vector<float> values;
  for (int i = 1; i <= 1000; ++i) values.push_back(static_cast<float>(i));
  histogram.add(values);
  EXPECT_EQ(histogram.total(), 1000u);
  EXPECT_NEAR(histogram.percentile(0.5), 500, 500 * 0.07);
  EXPECT_NEAR(histogram.percentile(0.99), 990, 990 * 0.07);
  EXPECT_NEAR(histogram.percentile(0), 1, 0.07);
  EXPECT_NEAR(histogram.percentile(1), 1000, 1000 * 0.07);
}

TEST(LogHistogram, LeavesOutWhatHasNoLogarithm) {
  LogHistogram histogram;
  histogram.add({0.f, -1.f, std::nanf(""), INFINITY, 4.f});
  EXPECT_EQ(histogram.total(), 1u);
  EXPECT_EQ(LogHistogram().percentile(0.5), 0);
}

TEST(CloudStatistics, OfChunksIsThatOfTheWhole) {
  const Cloud cloud = line(100);
  CloudStatistics chunks = statistics_of(line(40));
  chunks.add(cloud);
  EXPECT_EQ(chunks.count, 140u);
  EXPECT_EQ(chunks.upper[0], 99);
  EXPECT_EQ(chunks.centre()[0], 49.5f);
  EXPECT_NEAR(chunks.radius(), 49.5f, 1e-4f);
  EXPECT_TRUE(chunks.has_density);
  EXPECT_FALSE(chunks.has_colour);
}

TEST(SplatStyle, SpreadsColoursFromColdToHot) {
  const CloudStatistics statistics = statistics_of(line(200));
  const SplatStyle splat_style = make_splat_style({.cold = Rgb8{0, 0, 255}, .hot = Rgb8{255, 0, 0}}, statistics);
  EXPECT_EQ(splat_style.colour_source, ColourSource::temperature);
  EXPECT_FLOAT_EQ(splat_style.blue.front(), 1);
  EXPECT_FLOAT_EQ(splat_style.red.back(), 1);
  EXPECT_NEAR(splat_style.red[128], 0.5f, 0.01f);  // in linear light
  EXPECT_NEAR(splat_style.palette_first, std::log2(100 * std::exp2(4 / 20.f)), 0.1f);
}

TEST(SplatStyle, TakesColourMapsByName) {
  const CloudStatistics statistics = statistics_of(line(10));
  const SplatStyle inferno = make_splat_style({.colour_map = "inferno"}, statistics);
  EXPECT_GT(inferno.red.back(), 0.8f);
  EXPECT_LT(inferno.red.front(), 0.01f);
  expect_error(ErrorKind::wrong_usage, "inferno", [&] { make_splat_style({.colour_map = "mauve"}, statistics); });
}

TEST(SplatStyle, RefusesWhatMakesNoSense) {
  const CloudStatistics statistics = statistics_of(line(10));
  expect_error(ErrorKind::wrong_usage, "splat diameters", [&] { make_splat_style({.smallest_px = 0}, statistics); });
  expect_error(ErrorKind::wrong_usage, "splat diameters",
               [&] { make_splat_style({.smallest_px = 5, .largest_px = 4}, statistics); });
  expect_error(ErrorKind::wrong_usage, "opacity is 0", [&] { make_splat_style({.opacity = 0}, statistics); });
  expect_error(ErrorKind::wrong_usage, "hottest", [&] { make_splat_style({.coldest = 10, .hottest = 1}, statistics); });
}

}  // namespace wheatstone::appearance_test
