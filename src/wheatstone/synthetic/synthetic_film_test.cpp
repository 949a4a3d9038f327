#include "wheatstone/synthetic/synthetic_film.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "throws_error.h"
#include "wheatstone/image/mat_opencv.h"

namespace wheatstone::synthetic_film_test {

constexpr int width = 320, height = 180;

SyntheticFilmOptions small(FilmMotion motion = FilmMotion::walk) {
  SyntheticFilmOptions options;
  options.still.width = width;
  options.still.height = height;
  options.frames = 12;
  options.motion = motion;
  return options;
}

/// The same with one sample a pixel, where only motion and depth count.
SyntheticFilmOptions plain(FilmMotion motion = FilmMotion::walk) {
  SyntheticFilmOptions options = small(motion);
  options.still.samples_a_side = 1;
  return options;
}

/// True where the pixels about this one are not occluded and go the same way: a pixel on a thing's edge shows two
/// things that part.
bool is_inside(const Flow& flow, const Image<std::uint8_t>& occlusion, int x, int y) {
  if (x == 0 || y == 0 || x == width - 1 || y == height - 1) return false;
  for (int dy = -1; dy <= 1; ++dy)
    for (int dx = -1; dx <= 1; ++dx)
      if (occlusion(x + dx, y + dy) != 0 ||
          !(std::hypot(flow.x(x + dx, y + dy) - flow.x(x, y), flow.y(x + dx, y + dy) - flow.y(x, y)) < 0.1f))
        return false;
  return true;
}

/// Mean |own − other where the flow leads, that many pixels beside| inside of things, in 0..255. The other is
/// interpolated with Lanczos' window: bilinearly the finest texture would blur by more than it differs.
double mean_difference(const Image<Rgb8>& own, const Image<Rgb8>& other, const Flow& flow,
                       const Image<std::uint8_t>& occlusion, float error_px = 0, float flow_share = 1) {
  cv::Mat columns(height, width, CV_32F), rows(height, width, CV_32F), warped;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      columns.at<float>(y, x) = static_cast<float>(x) + flow_share * flow.x(x, y) + error_px;
      rows.at<float>(y, x) = static_cast<float>(y) + flow_share * flow.y(x, y);
    }
  }
  cv::remap(as_mat(other), warped, columns, rows, cv::INTER_LANCZOS4, cv::BORDER_REPLICATE);
  double sum = 0;
  int count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      if (!is_inside(flow, occlusion, x, y)) continue;
      const auto there = warped.at<cv::Vec3b>(y, x);
      const Rgb8 here = own(x, y);
      sum += std::abs(here.r - there[0]) + std::abs(here.g - there[1]) + std::abs(here.b - there[2]);
      ++count;
    }
  }
  EXPECT_GT(count, width * height / 4);
  return sum / (3.0 * count);
}

TEST(SyntheticFilm, TheNextFrameWarpedByTheFlowIsThisOne) {
  const SyntheticFilmFrame a = make_synthetic_film_frame(small(), 2), b = make_synthetic_film_frame(small(), 3);
  const auto forward = [&](float error_px, float share) {
    return mean_difference(a.pictures.left, b.pictures.left, a.to_next, a.next_occlusion, error_px, share);
  };
  EXPECT_LT(forward(0, 1), 2.7);  // texture finer than such small pixels; half as much at twice the size
  EXPECT_LT(mean_difference(b.pictures.left, a.pictures.left, b.to_previous, b.previous_occlusion), 2.7);
  // A tenth of a pixel is noticed, either way; half a pixel, no flow, and the opposite are plain.
  EXPECT_GT(forward(0.1f, 1), 1.03 * forward(0, 1));
  EXPECT_GT(forward(-0.1f, 1), 1.03 * forward(0, 1));
  EXPECT_GT(forward(0.5f, 1), 1.4 * forward(0, 1));
  EXPECT_GT(forward(0, 0), 3 * forward(0, 1));
  EXPECT_GT(forward(0, -1), 5 * forward(0, 1));
}

TEST(SyntheticFilm, ThingsMoveOnTheirOwn) {
  const SyntheticFilmFrame walk = make_synthetic_film_frame(plain(), 3);
  const SyntheticFilmFrame pan = make_synthetic_film_frame(plain(FilmMotion::pan), 3);
  const auto largest_step = [](const Flow& flow) {
    float largest = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 1; x < width; ++x)
        if (!std::isnan(flow.y(x, y))) largest = std::max(largest, std::abs(flow.y(x, y) - flow.y(x - 1, y)));
    return largest;
  };
  EXPECT_GT(largest_step(walk.to_next), 0.5f);
  EXPECT_LT(largest_step(pan.to_next), 0.01f);
}

// There and back is where one came from, where the point that is met there is the same.
TEST(SyntheticFilm, FlowComesBack) {
  const SyntheticFilmFrame a = make_synthetic_film_frame(plain(), 3), b = make_synthetic_film_frame(plain(), 4);
  int seen = 0, back = 0, hidden = 0, away = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const float fx = a.to_next.x(x, y), fy = a.to_next.y(x, y);
      const float tx = static_cast<float>(x) + 0.5f + fx, ty = static_cast<float>(y) + 0.5f + fy;
      const float off =
          std::hypot(fx + sample(b.to_previous.x.view(), tx, ty), fy + sample(b.to_previous.y.view(), tx, ty));
      const bool occluded = a.next_occlusion(x, y) != 0;
      if (occluded && tx > 0 && ty > 0 && tx < width && ty < height) ++hidden, away += off > 0.2f;
      if (!occluded) ++seen, back += off < 0.1f;
    }
  }
  EXPECT_GT(back, 0.97 * seen);  // the rest lies beside depth edges, where interpolation mixes two things
  EXPECT_GT(hidden, width * height / 200);
  EXPECT_GT(away, 0.6 * hidden);
}

TEST(SyntheticFilm, HasOneCutWithoutFlow) {
  SyntheticFilmOptions options = plain();
  options.still.height = 90;
  EXPECT_EQ(cut_of(options), 6);
  const SyntheticFilmFrame last = make_synthetic_film_frame(options, 5), first = make_synthetic_film_frame(options, 6);
  EXPECT_TRUE(std::isnan(last.to_next.x(160, 45)) && std::isnan(first.to_previous.x(160, 45)));
  EXPECT_TRUE(last.next_occlusion(160, 45) == 255 && first.previous_occlusion(160, 45) == 255);
  EXPECT_FALSE(std::isnan(last.to_previous.x(160, 45)) || std::isnan(first.to_next.x(160, 45)));
  options.cut = 0;
  EXPECT_EQ(cut_of(options), 0);
  EXPECT_FALSE(std::isnan(make_synthetic_film_frame(options, 5).to_next.x(160, 45)));
  EXPECT_TRUE(std::isnan(make_synthetic_film_frame(options, 11).to_next.x(160, 45)));
}

TEST(SyntheticFilm, NoiseHasTheDeviationAskedForAndIsNewInEachFrame) {
  SyntheticFilmOptions options = plain(FilmMotion::pan);
  const SyntheticFilmFrame clean = make_synthetic_film_frame(options, 2), next = make_synthetic_film_frame(options, 3);
  options.noise = 4;
  const SyntheticFilmFrame noisy = make_synthetic_film_frame(options, 2), later = make_synthetic_film_frame(options, 3);
  EXPECT_EQ(clean.to_next.x, noisy.to_next.x);
  double square = 0, product = 0;
  int count = 0;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const int g = clean.pictures.left(x, y).g, h = next.pictures.left(x, y).g;
      if (g < 20 || g > 235 || h < 20 || h > 235) continue;  // there the noise is cut off
      const double noise = noisy.pictures.left(x, y).g - g;
      square += noise * noise;
      product += noise * (later.pictures.left(x, y).g - h);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(square / count), 4, 0.08);
  EXPECT_LT(std::abs(product), 0.03 * square);
}

TEST(SyntheticFilm, TheFirstFrameIsTheStillWhereNothingMoves) {
  const SyntheticFilmOptions options = plain(FilmMotion::pan);
  const SyntheticFilmFrame first = make_synthetic_film_frame(options, 0);
  const SyntheticStill still = make_synthetic_still(options.still);
  EXPECT_EQ(first.geometry.left_disparity, still.geometry.left_disparity);
  EXPECT_EQ(first.geometry.right_occlusion, still.geometry.right_occlusion);
}

SyntheticFilmOptions small_scene(FilmScene scene) {
  SyntheticFilmOptions options = small();
  options.still.samples_a_side = 2;
  options.scene = scene;
  return options;
}

/// The share of the pixels that `holds` says of their flow.
template <class Holds>
double share_of(const Flow& flow, Holds holds) {
  int count = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) count += holds(flow.x(x, y), flow.y(x, y)) ? 1 : 0;
  return static_cast<double>(count) / (width * height);
}

void expect_flow_leads_to_the_next_frame(const SyntheticFilmFrame& now, const SyntheticFilmFrame& next) {
  const auto forward = [&](float error_px, float share) {
    return mean_difference(now.pictures.left, next.pictures.left, now.to_next, now.next_occlusion, error_px, share);
  };
  EXPECT_GT(forward(0.5f, 1), 1.15 * forward(0, 1));
  EXPECT_GT(forward(-0.5f, 1), 1.15 * forward(0, 1));
  EXPECT_GT(forward(0, 0), 2.5 * forward(0, 1));
}

void expect_disparity_leads_to_the_right_eye(const SyntheticFilmFrame& frame) {
  Flow across{frame.geometry.left_disparity, Image<float>(width, height, 0)};
  for (float& v : across.x.pixels()) v = -v;
  const auto difference = [&](float error_px) {
    return mean_difference(frame.pictures.left, frame.pictures.right, across, frame.geometry.left_occlusion, error_px);
  };
  EXPECT_GT(difference(1), 1.3 * difference(0));
  EXPECT_GT(difference(-1), 1.3 * difference(0));
}

TEST(SyntheticFilm, PassesThinBeamsFastAndBlursThem) {
  SyntheticFilmOptions options = small_scene(FilmScene::beams);
  options.still.samples_a_side = 1;  // a moment of the exposure has one sample at least
  const SyntheticFilmFrame now = make_synthetic_film_frame(options, 2), next = make_synthetic_film_frame(options, 3);
  // The wall goes by at more than a hundredth of the width a frame, and what is near much faster.
  EXPECT_GT(share_of(now.to_next, [](float x, float) { return x < -0.012f * width; }), 0.95);
  EXPECT_GT(share_of(now.to_next, [](float x, float) { return x < -0.022f * width; }), 0.05);
  EXPECT_EQ(cut_of(options), 0);
  expect_flow_leads_to_the_next_frame(now, next);
  expect_disparity_leads_to_the_right_eye(now);
  // A beam's edge is as wide as its way while the shutter is open. The crowd's edges are sharp.
  const auto steep_steps = [](const Image<Rgb8>& picture) {
    int count = 0;
    for (int y = 0; y < height; ++y)
      for (int x = 1; x < width; ++x) count += std::abs(picture(x, y).g - picture(x - 1, y).g) > 60 ? 1 : 0;
    return count;
  };
  const SyntheticFilmFrame sharp = make_synthetic_film_frame(small_scene(FilmScene::crowd), 2);
  EXPECT_GT(steep_steps(sharp.pictures.left), 300);
  EXPECT_LT(steep_steps(now.pictures.left), steep_steps(sharp.pictures.left) / 4);
}

TEST(SyntheticFilm, StandsStillButForItsNoise) {
  SyntheticFilmOptions options = small_scene(FilmScene::still);
  options.still.samples_a_side = 1;
  EXPECT_NE(make_synthetic_film_frame(options, 4).pictures.left, make_synthetic_film_frame(options, 5).pictures.left);
  options.noise = 0;
  const SyntheticFilmFrame now = make_synthetic_film_frame(options, 4), next = make_synthetic_film_frame(options, 5);
  EXPECT_EQ(now.pictures.left, next.pictures.left);
  EXPECT_EQ(now.pictures.right, next.pictures.right);
  EXPECT_EQ(share_of(now.to_next, [](float x, float y) { return std::hypot(x, y) < 1e-3f; }), 1);
}

TEST(SyntheticFilm, ManyFiguresCrossBothWays) {
  const SyntheticFilmOptions options = small_scene(FilmScene::crowd);
  const SyntheticFilmFrame now = make_synthetic_film_frame(options, 5), next = make_synthetic_film_frame(options, 6);
  EXPECT_GT(share_of(now.to_next, [](float x, float) { return x > 1; }), 0.05);
  EXPECT_GT(share_of(now.to_next, [](float x, float) { return x < -1; }), 0.05);
  EXPECT_GT(share_of(now.to_next, [](float x, float y) { return std::hypot(x, y) < 1e-3f; }), 0.5);
  expect_flow_leads_to_the_next_frame(now, next);
  expect_disparity_leads_to_the_right_eye(now);
}

TEST(SyntheticFilm, RefusesNonsense) {
  const auto refused = [](const std::string& part, auto change, int frame = 0) {
    SyntheticFilmOptions options = small();
    change(options);
    expect_error(ErrorKind::wrong_usage, part, [&] { make_synthetic_film_frame(options, frame); });
  };
  refused("film of 0 frames", [](auto& o) { o.frames = 0; });
  refused("cut at frame 12", [](auto& o) { o.cut = 12; });
  refused("cut at frame -1", [](auto& o) { o.cut = -1; });
  refused("noise of nan", [](auto& o) { o.noise = NAN; });
  refused("0x180 pixels", [](auto& o) { o.still.width = 0; });
  refused(
      "frame 12 of a film of 12", [](auto&) {}, 12);
}

}  // namespace wheatstone::synthetic_film_test
