#include <cmath>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/opencv_internal.h"
#include "wheatstone/painting/edge_chains_internal.h"

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
      smooth(chain);
      chains.push_back(std::move(chain));
    }
  }
  return chains;
}

}  // namespace wheatstone
