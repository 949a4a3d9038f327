#include "wheatstone/painting/over_spots_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

constexpr int tile_px = 16;  // nearly all marks over spots reach less far

/// Some tiles of one row, side by side.
struct TileRun {
  int row, first, end;

  cv::Rect pixels(int width, int height) const {
    const int left = first * tile_px, top = row * tile_px;
    return {left, top, std::min(end * tile_px, width) - left, std::min(top + tile_px, height) - top};
  }
};

/// Not 0 for the tiles that have a spot, and those beside them.
Image<std::uint8_t> tiles_about(ImageView<const std::uint8_t> spots) {
  Image<std::uint8_t> has_spot((spots.width() + tile_px - 1) / tile_px, (spots.height() + tile_px - 1) / tile_px);
  tbb::parallel_for(0, has_spot.height(), [&](int row) {
    const auto tiles = has_spot.row(row);
    for (int y = row * tile_px; y < std::min((row + 1) * tile_px, spots.height()); ++y) {
      const auto pixels = spots.row(y);
      // Nearly all pixels are 0.
      for (std::size_t x = 0; x < pixels.size();) {
        const void* const next = std::memchr(&pixels[x], 255, pixels.size() - x);
        if (next == nullptr) break;
        x = static_cast<std::size_t>(static_cast<const std::uint8_t*>(next) - pixels.data()) / tile_px;
        tiles[x] = 255;
        x = (x + 1) * tile_px;
      }
    }
  });
  Image<std::uint8_t> about(has_spot.width(), has_spot.height());
  cv::Mat to = as_mat(about);
  cv::dilate(as_mat(has_spot), to, cv::getStructuringElement(cv::MORPH_RECT, {3, 3}));
  return about;
}

}  // namespace

Image<float> disparity_before(ImageView<const float> disparity, ImageView<const std::uint8_t> spots) {
  constexpr int about_px = 9;
  constexpr float before_px = 1.5f;
  Image<float> nearest(disparity.width(), disparity.height());
  const cv::Mat from = as_mat(disparity), window = cv::getStructuringElement(cv::MORPH_RECT, {about_px, about_px});
  const cv::Mat to = as_mat(nearest);
  const Image<std::uint8_t> wanted = tiles_about(spots);
  tbb::parallel_for(0, wanted.height(), [&](int row) {
    for (int column = 0; column < wanted.width(); ++column) {
      if (wanted(column, row) == 0) continue;
      TileRun run{row, column, column};
      while (run.end < wanted.width() && wanted(run.end, row) != 0) ++run.end;
      column = run.end;
      const cv::Rect pixels = run.pixels(disparity.width(), disparity.height());
      cv::Mat part = to(pixels);
      cv::dilate(from(pixels), part, window);
      part += before_px;
    }
  });
  return nearest;
}

ViewRange views_about(ViewPosition view, ViewPosition reference) {
  const float reach = std::abs(view - reference) / 4, at = view.eye_separations();
  return {ViewPosition(at - reach), ViewPosition(at + reach)};
}

}  // namespace wheatstone
