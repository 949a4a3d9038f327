#include "wheatstone/motion/flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/core/utility.hpp>

#include "throws_error.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::flow_test {

struct TwoFrames {
  SyntheticFilmFrame first, second;
};

TwoFrames two_frames() {
  SyntheticFilmOptions options;
  options.still.width = 480;
  options.still.height = 270;
  options.still.samples_a_side = 1;
  options.cut = 0;
  return {make_synthetic_film_frame(options, 3), make_synthetic_film_frame(options, 4)};
}

/// Mean distance between flows over what is marked.
double end_point_error(const Flow& flow, const Flow& truth, const Image<std::uint8_t>& mask, std::uint8_t marked) {
  double sum = 0;
  int count = 0;
  for (int y = 0; y < mask.height(); ++y)
    for (int x = 0; x < mask.width(); ++x)
      if (mask(x, y) == marked) ++count, sum += std::hypot(flow.x(x, y) - truth.x(x, y), flow.y(x, y) - truth.y(x, y));
  return sum / std::max(count, 1);
}

Flow constant_flow(int width, int height, float x, float y) {
  return {Image<float>(width, height, x), Image<float>(width, height, y)};
}

TEST(EstimateFlow, ComesNearTheTruthByEitherMethod) {
  const TwoFrames frames = two_frames();
  const auto& [a, b] = frames;
  const double still = end_point_error(constant_flow(480, 270, 0, 0), a.to_next, a.next_occlusion, 0);
  for (const FlowMethod method : {FlowMethod::farneback, FlowMethod::dis}) {
    FlowOptions options{method, nullptr};
    const FlowPair flow = estimate_flow(a.pictures.left, b.pictures.left, options);
    const double forward = end_point_error(flow.forward, a.to_next, a.next_occlusion, 0);
    const double backward = end_point_error(flow.backward, b.to_previous, b.previous_occlusion, 0);
    const Image<std::uint8_t> mask = confirmed(flow.forward, flow.backward);
    Image<std::uint8_t> trusted = mask;
    for (int y = 0; y < 270; ++y)
      for (int x = 0; x < 480; ++x)
        if (a.next_occlusion(x, y) != 0) trusted(x, y) = 0;
    const double bound = method == FlowMethod::dis ? 0.5 : 0.9;
    EXPECT_LT(forward, bound);
    EXPECT_LT(backward, bound);
    EXPECT_GT(still, 2 * forward);
    EXPECT_LT(end_point_error(flow.forward, a.to_next, trusted, 255), forward);
    const FlowPair truth{a.to_next, b.to_previous};
    options.start = &truth;
    const FlowPair started = estimate_flow(a.pictures.left, b.pictures.left, options);
    EXPECT_LT(end_point_error(started.forward, a.to_next, a.next_occlusion, 0), forward);
  }
}

TEST(EstimateFlow, IsTheSameOnAnyNumberOfThreads) {
  const TwoFrames frames = two_frames();
  const int before = cv::getNumThreads();
  for (const FlowMethod method : {FlowMethod::farneback, FlowMethod::dis}) {
    cv::setNumThreads(1);
    const FlowPair alone = estimate_flow(frames.first.pictures.left, frames.second.pictures.left, {method, nullptr});
    cv::setNumThreads(5);
    const FlowPair crowd = estimate_flow(frames.first.pictures.left, frames.second.pictures.left, {method, nullptr});
    EXPECT_EQ(alone.forward.x, crowd.forward.x);
    EXPECT_EQ(alone.backward.y, crowd.backward.y);
  }
  cv::setNumThreads(before);
}

TEST(EstimateFlow, RefusesWhatDoesNotFit) {
  const Image<Rgb8> frame(64, 48), other(64, 47), tiny(8, 8);
  expect_error(ErrorKind::bad_input, "64x47 pixels, expected 64x48", [&] { estimate_flow(frame, other); });
  expect_error(ErrorKind::bad_input, "8x8 pixels", [&] { estimate_flow(tiny, tiny); });
  const FlowPair start{constant_flow(64, 48, 0, 0), constant_flow(32, 48, 0, 0)};
  expect_error(ErrorKind::bad_input, "flow to start from of 32x48", [&] {
    estimate_flow(frame, frame, {FlowMethod::dis, &start});
  });
}

TEST(Confirmed, IsExactlyThePublishedRule) {
  // Opposite flows agree; (f + b)² may reach 0.01 (f² + b²) + 0.5.
  const auto middle = [](float b, float f) {
    return confirmed(constant_flow(64, 9, b, 0), constant_flow(64, 9, f, 0))(32, 4);
  };
  EXPECT_EQ(middle(3, -3), 255);
  EXPECT_EQ(middle(3, 3), 0);
  EXPECT_EQ(middle(0, 0.7f), 255);    // 0.49 against 0.5049
  EXPECT_EQ(middle(0, 0.72f), 0);     // 0.5184 against 0.5052
  EXPECT_EQ(middle(10, -8.6f), 255);  // 1.96 against 2.2396
  EXPECT_EQ(middle(10, -8.4f), 0);    // 2.56 against 2.2056
}

TEST(Confirmed, LeavesOutMotionEdgesAndWhatIsNotKnown) {
  Flow own = constant_flow(64, 32, 2, 0);
  const Flow other = constant_flow(64, 32, -2, 0);
  // |∇b|² may reach 0.01 · 4 + 0.002 = 0.042: slopes of 0.2 may, of 0.21 may not.
  const auto with_slope = [&](float slope) {
    for (int y = 0; y < 32; ++y) own.y(30, y) = -slope, own.y(31, y) = 0, own.y(32, y) = slope;
    return confirmed(own, other)(31, 16);
  };
  EXPECT_EQ(with_slope(0.2f), 255);
  EXPECT_EQ(with_slope(0.21f), 0);
  const Image<std::uint8_t> mask = confirmed(constant_flow(64, 32, 2, 0), other);
  EXPECT_EQ(mask(61, 16), 255);
  EXPECT_EQ(mask(62, 16), 0);  // leads out of the picture
  own = constant_flow(64, 32, 2, 0);
  own.x(20, 20) = NAN;
  EXPECT_EQ(confirmed(own, other)(20, 20), 0);
  EXPECT_EQ(confirmed(constant_flow(64, 32, 2, 0), own)(18, 20), 0);
  expect_error(ErrorKind::bad_input, "sizes", [&] { confirmed(own, constant_flow(63, 32, 0, 0)); });
}

TEST(Confirmed, LeavesOutMostOfWhatIsHidden) {
  const auto [a, b] = two_frames();
  const Image<std::uint8_t> mask = confirmed(a.to_next, b.to_previous);
  int hidden = 0, left_out = 0, seen = 0, kept = 0;
  for (int y = 0; y < 270; ++y) {
    for (int x = 0; x < 480; ++x) {
      const bool is_hidden = a.next_occlusion(x, y) != 0;
      hidden += is_hidden, left_out += is_hidden && mask(x, y) == 0;
      seen += !is_hidden, kept += !is_hidden && mask(x, y) != 0;
    }
  }
  EXPECT_GT(left_out, 0.7 * hidden);
  EXPECT_GT(kept, 0.85 * seen);
}

TEST(Sample, InterpolatesBetweenCentresAndContinuesTheBorder) {
  Image<float> image(2, 2);
  image(0, 0) = 0, image(1, 0) = 1, image(0, 1) = 2, image(1, 1) = 3;
  EXPECT_EQ(sample(image.view(), 0.5f, 0.5f), 0);
  EXPECT_EQ(sample(image.view(), 1, 1), 1.5f);
  EXPECT_EQ(sample(image.view(), 1.25f, 0.5f), 0.75f);
  EXPECT_EQ(sample(image.view(), -7, 0.1f), 0);
  EXPECT_EQ(sample(image.view(), 9, 9), 3);
  Image<Rgb8> picture(2, 1);
  picture(1, 0) = {200, 100, 50};
  EXPECT_EQ(sample(picture.view(), 1, 0.5f).g, 50);
}

TEST(EstimateFlow, OfStripsIsFoundOrRefused) {
  for (const auto& [width, height] : {std::pair(20000, 16), std::pair(16, 20000)}) {
    const Image<Rgb8> strip(width, height);
    EXPECT_EQ(estimate_flow(strip, strip, {}).forward.x.width(), width);
  }
  const Image<Rgb8> long_strip(40000, 16);
  expect_error(ErrorKind::bad_input, "40000x16 pixels, expected at most",
               [&] { estimate_flow(long_strip, long_strip, {}); });
}

}  // namespace wheatstone::flow_test
