#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/curves/edge_chains_internal.h"
#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/motion/flow.h"

namespace wheatstone {
namespace {

/// 255 on the nearer side of every jump of disparity, a pixel wide.
Image<std::uint8_t> depth_jumps(ImageView<const float> disparity, float threshold_px) {
  Image<std::uint8_t> jumps(disparity.width(), disparity.height());
  const auto compare = [&](int x, int y, int nx, int ny) {
    const float step = disparity(nx, ny) - disparity(x, y);
    if (step > threshold_px) jumps(nx, ny) = 255;
    if (step < -threshold_px) jumps(x, y) = 255;
  };
  for (int y = 0; y < disparity.height(); ++y) {
    for (int x = 0; x < disparity.width(); ++x) {
      if (x + 1 < disparity.width()) compare(x, y, x + 1, y);
      if (y + 1 < disparity.height()) compare(x, y, x, y + 1);
    }
  }
  return jumps;
}

Image<std::uint8_t> edge_pixels(ImageView<const Rgb8> picture, ImageView<const float> disparity,
                                const EdgeOptions& options) {
  Image<std::uint8_t> edges = depth_jumps(disparity, options.depth_threshold_px);
  cv::Mat luminance, canny, beside_jump;
  cv::cvtColor(as_mat(picture), luminance, cv::COLOR_RGB2GRAY);
  cv::Canny(luminance, canny, options.weak, options.strong);
  cv::dilate(as_mat(edges), beside_jump, cv::getStructuringElement(cv::MORPH_RECT, {5, 5}));
  if (!options.known.empty()) {
    cv::Mat faint;
    cv::Canny(luminance, faint, options.faintest, options.faintest);
    cv::bitwise_or(canny, faint, canny, as_mat(options.known));
  }
  for (int y = 0; y < edges.height(); ++y)
    for (int x = 0; x < edges.width(); ++x)
      if (canny.at<std::uint8_t>(y, x) != 0 && beside_jump.at<std::uint8_t>(y, x) == 0) edges(x, y) = 255;
  return edges;
}

/// Follows edge pixels from one, taking them off the picture; straight neighbours before slanting ones.
void follow(Image<std::uint8_t>& edges, int x, int y, std::vector<PlanePoint>& chain) {
  constexpr int steps[8][2] = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
  for (bool found = true; found;) {
    edges(x, y) = 0;
    chain.push_back({static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
    found = false;
    for (const auto& step : steps) {
      const int nx = x + step[0], ny = y + step[1];
      if (!edges.contains(nx, ny) || edges(nx, ny) == 0) continue;
      x = nx;
      y = ny;
      found = true;
      break;
    }
  }
}

/// How steep the picture's luminance is, between pixels too.
class Steepness {
 public:
  explicit Steepness(ImageView<const Rgb8> picture)
      : x_(picture.width(), picture.height()), y_(picture.width(), picture.height()), length_(x_) {
    cv::Mat luminance, to_x = as_mat(x_), to_y = as_mat(y_), to_length = as_mat(length_);
    cv::cvtColor(as_mat(picture), luminance, cv::COLOR_RGB2GRAY);
    cv::Sobel(luminance, to_x, CV_32F, 1, 0);
    cv::Sobel(luminance, to_y, CV_32F, 0, 1);
    cv::magnitude(to_x, to_y, to_length);
  }

  /// The place of the steepest slope about a point, across the edge there; the point itself where there is none.
  PlanePoint steepest_about(PlanePoint p) const {
    constexpr float least = 8;
    const int px = static_cast<int>(p.x), py = static_cast<int>(p.y);
    const float length = length_(px, py);
    if (length < least) return p;
    const float across_x = x_(px, py) / length, across_y = y_(px, py) / length;
    constexpr int reach = 3;
    constexpr float step_px = 0.5f;
    float steep[2 * reach + 1];
    for (int i = -reach; i <= reach; ++i) {
      const float offset = static_cast<float>(i) * step_px;
      steep[i + reach] = sample(length_.view(), p.x + offset * across_x, p.y + offset * across_y);
    }
    int best = reach;
    for (int i = 1; i < 2 * reach; ++i)
      if (steep[i] > steep[best]) best = i;
    const float before = steep[best - 1], here = steep[best], after = steep[best + 1];
    const float bend = before - 2 * here + after;
    if (bend >= 0 || here < before || here < after) return p;
    const float offset = step_px * (static_cast<float>(best - reach) + (before - after) / (2 * bend));
    return {p.x + offset * across_x, p.y + offset * across_y};
  }

 private:
  Image<float> x_, y_, length_;
};

void smooth(std::vector<PlanePoint>& chain) {
  constexpr int rounds = 3;
  for (int round = 0; round < rounds; ++round) {
    const std::vector<PlanePoint> before = chain;
    for (std::size_t i = 1; i + 1 < chain.size(); ++i)
      chain[i] = {(before[i - 1].x + 2 * before[i].x + before[i + 1].x) / 4,
                  (before[i - 1].y + 2 * before[i].y + before[i + 1].y) / 4};
  }
}

}  // namespace

std::vector<std::vector<PlanePoint>> find_edge_chains(ImageView<const Rgb8> picture, ImageView<const float> disparity,
                                                      const EdgeOptions& options) {
  Image<std::uint8_t> edges = edge_pixels(picture, disparity, options);
  const Steepness steepness(picture);
  std::vector<std::vector<PlanePoint>> chains;
  for (int y = 0; y < edges.height(); ++y) {
    for (int x = 0; x < edges.width(); ++x) {
      if (edges(x, y) == 0) continue;
      // Both ways from where the edge is met first.
      std::vector<PlanePoint> back, chain;
      follow(edges, x, y, back);
      chain.assign(back.rbegin(), back.rend());
      chain.pop_back();
      follow(edges, x, y, chain);
      if (chain.size() < options.least_points) continue;
      for (PlanePoint& point : chain) point = steepness.steepest_about(point);
      smooth(chain);
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

}  // namespace wheatstone
