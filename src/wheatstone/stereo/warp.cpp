#include "wheatstone/stereo/warp.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "wheatstone/depth/warp_row.h"
#include "wheatstone/stereo/compose_row_internal.h"

namespace wheatstone {
namespace {

template <class Land>
void warp_row(std::span<const float> disparity, float separation, Land land) {
  warp_row(disparity, separation, static_cast<int>(disparity.size()), 0, land);
}

}  // namespace

void warp_disparity_over(ImageView<const float> disparity, ViewPosition from, ViewPosition to, Image<float>& nearest) {
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    warp_disparity_row_over(disparity.row(y), to - from, 0, nearest.row(y), Landing::every_pixel);
  });
}

Image<float> warp_disparity(ImageView<const float> disparity, ViewPosition from, ViewPosition to) {
  Image<float> warped(disparity.width(), disparity.height(), std::numeric_limits<float>::quiet_NaN());
  warp_disparity_over(disparity, from, to, warped);
  return warped;
}

WarpedPicture warp_picture(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition from,
                           ViewPosition to) {
  const int width = picture.width();
  WarpedPicture warped{Image<Rgb8>(width, picture.height()), Image<std::uint8_t>(width, picture.height())};
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height()), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(width);
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, -std::numeric_limits<float>::infinity());
      const auto colours = picture.row(y);
      const auto row = warped.picture.row(y);
      const auto covered = warped.covered.row(y);
      warp_row(disparity.row(y), to - from, [&](int target, float d, int x, float t) {
        if (d <= nearest[target]) return;
        nearest[target] = d;
        row[target] = t > 0 ? blend(colours[x], colours[x + 1], t) : colours[x];
        covered[target] = 255;
      });
    }
  });
  return warped;
}

WarpedColumns warp_columns(ImageView<const float> disparity, ViewPosition from, ViewPosition to) {
  constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();
  WarpedColumns warped{Image<float>(disparity.width(), disparity.height(), nowhere),
                       Image<float>(disparity.width(), disparity.height(), nowhere)};
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto column = warped.column.row(y), nearest = warped.disparity.row(y);
    warp_row(disparity.row(y), to - from, [&](int target, float d, int x, float t) {
      if (nearest[target] >= d) return;
      nearest[target] = d;
      column[target] = static_cast<float>(x) + t;
    });
  });
  return warped;
}

void warp_picture_over(ImageView<const Rgb8> picture, ImageView<const float> disparity, ViewPosition from,
                       float tolerance_px, Composition& composition) {
  const float separation = composition.position - from;
  const auto shown_width = static_cast<std::size_t>(composition.picture.width());
  tbb::parallel_for(tbb::blocked_range<int>(0, picture.height()), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(shown_width), fractions(shown_width);
    std::vector<std::int32_t> columns(shown_width);
    const LandedFrom landed_from{columns, fractions};
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, -std::numeric_limits<float>::infinity());
      warp_disparity_row_over(disparity.row(y), separation, -composition.left_px, nearest, landed_from);
      compose_row({picture.row(y), nearest, landed_from}, tolerance_px, composition.picture.row(y),
                  composition.nearest.row(y));
    }
  });
}

void lay_over(const WarpedPicture& warped, Image<Rgb8>& picture) {
  tbb::parallel_for(0, picture.height(), [&](int y) {
    const auto from = warped.picture.row(y);
    const auto covered = warped.covered.row(y);
    const auto to = picture.row(y);
    for (int x = 0; x < picture.width(); ++x)
      if (covered[x] != 0) to[x] = from[x];
  });
}

}  // namespace wheatstone
