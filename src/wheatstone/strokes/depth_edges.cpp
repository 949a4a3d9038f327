#include "wheatstone/strokes/depth_edges_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
namespace wheatstone {
namespace {

/// Disparities are compared in sixteenths of a pixel: that is as fine as matching gets, and half the work of floats.
constexpr float steps_a_px = 16;

/// Calls `work(first_row, end_row)` for bands of rows of a picture, in parallel.
template <class Work>
void for_each_band(int height, int band_rows, Work work) {
  tbb::parallel_for(0, (height + band_rows - 1) / band_rows,
                    [&](int band) { work(band * band_rows, std::min((band + 1) * band_rows, height)); });
}

Image<std::uint8_t> marked(ImageView<const std::int16_t> steps, float reach_px, float threshold_px, bool only_behind) {
  const DepthEdgeMarks wanted{steps, static_cast<int>(std::ceil(reach_px)),
                              static_cast<std::int16_t>(std::min(threshold_px * steps_a_px, 32767.f)), only_behind};
  Image<std::uint8_t> marks(steps.width(), steps.height());
  for_each_band(steps.height(), std::max(64, 2 * wanted.reach_px),
                [&](int first, int end) { mark_depth_edges(wanted, first, end, marks); });
  return marks;
}

}  // namespace

Image<std::int16_t> disparity_in_steps(ImageView<const float> disparity) {
  Image<std::int16_t> steps(disparity.width(), disparity.height());
  tbb::parallel_for(0, disparity.height(), [&](int y) {
    const auto from = disparity.row(y);
    const auto to = steps.row(y);
    for (int x = 0; x < disparity.width(); ++x)
      to[x] = static_cast<std::int16_t>(
          static_cast<int>(std::max(std::min(from[x] * steps_a_px + std::copysign(0.5f, from[x]), 32767.f), -32767.f)));
  });
  return steps;
}

Image<std::uint8_t> near_depth_edge(ImageView<const std::int16_t> steps, float radius_px, float threshold_px) {
  return marked(steps, radius_px, threshold_px, false);
}

KnownRuns distance_to_depth_edge(ImageView<const std::int16_t> steps, float threshold_px, float most_px) {
  constexpr int rows_a_band = 64, rows_at_a_time = 8 * rows_a_band;
  const Image<std::uint8_t> edges = near_depth_edge(steps, 1, threshold_px);
  KnownRuns distances(steps.width(), steps.height());
  Image<float> some(steps.width(), std::min(rows_at_a_time, steps.height()));
  for (int top = 0; top < steps.height(); top += rows_at_a_time) {
    const int rows = std::min(rows_at_a_time, steps.height() - top);
    for_each_band(rows, rows_a_band, [&](int first, int end) {
      measure_edge_distances(edges, most_px, top + first, {&some(0, first), some.width(), end - first, some.width()});
    });
    for (int y = 0; y < rows; ++y) distances.add_row(some.row(y));
  }
  return distances;
}

Image<std::uint8_t> behind_depth_edge(ImageView<const std::int16_t> steps, float reach_px, float threshold_px) {
  return marked(steps, reach_px, threshold_px, true);
}

}  // namespace wheatstone
