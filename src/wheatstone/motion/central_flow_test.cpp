#include "wheatstone/motion/central_flow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "wheatstone/measures/film_measures.h"
#include "wheatstone/synthetic/synthetic_film.h"

namespace wheatstone::central_flow_test {

TEST(CentralFlow, LeadsFromOneCentralViewToTheNext) {
  SyntheticFilmOptions options;
  options.still = {.width = 320, .height = 180, .samples_a_side = 1};
  options.cut = 0;
  const SyntheticFilmFrame first = make_synthetic_film_frame(options, 3),
                           second = make_synthetic_film_frame(options, 4);
  const CentralView a = make_central_view(first.pictures, first.geometry);
  const CentralView b = make_central_view(second.pictures, second.geometry);
  const FlowPair left{first.to_next, second.to_previous};
  const FlowPair central =
      central_flow(left, {first.geometry.left_disparity, a.disparity}, {second.geometry.left_disparity, b.disparity});
  for (const Image<float>* image : {&central.forward.x, &central.forward.y, &central.backward.x, &central.backward.y})
    for (const float value : image->pixels()) ASSERT_TRUE(std::isfinite(value));
  const auto error = [&](const FlowPair& flow) {
    const Image<std::uint8_t> mask = confirmed(central.forward, central.backward);
    return measure_warp_error(a.picture, b.picture, flow.forward, mask);
  };
  EXPECT_GT(error(central).compared_share, 0.7);
  // The left view's flow, taken as it stands, leads beside the point.
  EXPECT_LT(error(central).error, 0.85 * error(left).error);
  const double still = measure_warp_error(first.pictures.left, second.pictures.left, left.forward,
                                          confirmed(left.forward, left.backward))
                           .error;
  EXPECT_LT(error(central).error, 2 * still);
}

}  // namespace wheatstone::central_flow_test
