#include "wheatstone/stereo/outer_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/warp.h"

namespace wheatstone {
namespace {

constexpr float one_surface_px = 2;

/// A run of a scan line that no photograph shows.
struct UnseenRun {
  int begin, end;
};

/// Fills what no photograph shows in one row of an outer view, where `mask` is set.
class RowFiller {
 public:
  RowFiller(std::span<const View> eyes, int y, Composition& outer, std::span<const std::uint8_t> mask)
      : eyes_(eyes), y_(y), outer_(outer), surface_(outer.nearest.row(y)), mask_(mask), width_(outer.nearest.width()) {}

  void fill() {
    for (UnseenRun run{0, 0}; run.begin < width_; run.begin = run.end) {
      if (mask_[run.begin] == 0) {
        run.end = run.begin + 1;
        continue;
      }
      run.end = run.begin;
      while (run.end < width_ && mask_[run.end] != 0) ++run.end;
      fill(run);
    }
  }

 private:
  /// Whether an eye would see the surface there, if it had this disparity. In fact neither eye sees it, or a photograph
  /// would show it.
  bool is_seen(int x, float disparity, const View& eye) const {
    const float there = static_cast<float>(x + outer_.left_px) + 0.5f - (eye.position - outer_.position) * disparity;
    const int column = static_cast<int>(std::floor(there));
    return eye.disparity.contains(column, y_) && eye.disparity(column, y_) < disparity - one_surface_px;
  }

  bool may_have(const UnseenRun& run, float disparity) const {
    constexpr int most_seen = 20;  // of which one may be seen: disparities have noise
    int seen = 0;
    for (int x = run.begin; x < run.end; ++x)
      if (is_seen(x, disparity, eyes_[0]) || is_seen(x, disparity, eyes_[1])) ++seen;
    return most_seen * seen <= run.end - run.begin;
  }

  /// The column of the closest known surface beside a run that may continue in the run without being seen by an eye; if
  /// there is none, of the farthest surface; -1 if nothing is known.
  int source_of(const UnseenRun& run) const {
    int farthest = -1;
    for (int away = 1; away <= width_; ++away) {
      for (const int x : {run.begin - away, run.end - 1 + away}) {
        constexpr float as_near_px = 0.5f;
        if (x < 0 || x >= width_ || mask_[x] != 0) continue;
        // A surface as near as one that an eye would see would be seen, too.
        if (farthest >= 0 && surface_[x] > surface_[farthest] - as_near_px) continue;
        farthest = x;
        if (may_have(run, surface_[x])) return x;
      }
    }
    return farthest;
  }

  /// The surface goes on, with its colours mirrored as far as they are known.
  void fill(const UnseenRun& run) {
    const int source = source_of(run);
    if (source < 0) return;
    const float disparity = surface_[source];
    const bool from_left = source < run.begin;
    const auto colours = outer_.picture.row(y_);
    for (int x = run.begin; x < run.end; ++x) {
      const int mirrored = from_left ? source - (x - run.begin) : source + (run.end - 1 - x);
      const bool there = mirrored >= 0 && mirrored < width_ && mask_[mirrored] == 0 &&
                         std::abs(surface_[mirrored] - disparity) <= one_surface_px;
      colours[x] = colours[there ? mirrored : source];
      surface_[x] = disparity;
    }
  }

  std::span<const View> eyes_;
  int y_;
  Composition& outer_;
  std::span<float> surface_;
  std::span<const std::uint8_t> mask_;
  int width_;
};

/// Runs of a mask that a surface leaves because it is stretched.
void leave_out_cracks(std::span<std::uint8_t> mask) {
  constexpr std::ptrdiff_t widest_px = 2;
  for (auto begin = std::ranges::find(mask, 255); begin != mask.end();) {
    const auto end = std::find(begin, mask.end(), 0);
    if (end - begin <= widest_px) std::fill(begin, end, std::uint8_t{0});
    begin = std::find(end, mask.end(), 255);
  }
}

}  // namespace

View make_outer_view(std::span<const View> eyes, ViewPosition position, float zero_parallax_px) {
  constexpr float lies_before_px = 1;
  const View &left = eyes[0], &right = eyes[1];
  const int width = left.colour.width(), height = left.colour.height(), scale = left.frame.scale;
  const auto origin =
      static_cast<int>(std::lround(-(position - central_view) * (zero_parallax_px / static_cast<float>(scale))));
  Composition seen{position, Image<Rgb8>(width, height),
                   Image<float>(width, height, std::numeric_limits<float>::quiet_NaN()), origin};
  const auto lay = [&](const View& eye) {
    warp_picture_over(eye.colour, eye.disparity, eye.position, lies_before_px, seen);
  };
  if (position < central_view) lay(left);
  lay(right);
  if (position >= central_view) lay(left);

  Image<std::uint8_t> uncovered(width, height);
  tbb::parallel_for(0, height, [&](int y) {
    const auto mask = uncovered.row(y);
    const auto surface = seen.nearest.row(y);
    for (int x = 0; x < width; ++x) mask[x] = std::isnan(surface[x]) ? 255 : 0;
    RowFiller(eyes, y, seen, mask).fill();
    leave_out_cracks(mask);
  });
  fill_from_farther_side(seen.nearest);  // rows without anything known
  return {
      std::move(seen.picture), std::move(seen.nearest), std::move(uncovered), position, {origin * scale, scale}, true};
}

}  // namespace wheatstone
