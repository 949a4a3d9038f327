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

/// Fills what no photograph shows in one row of an outer view.
class RowFiller {
 public:
  RowFiller(const StereoGeometryView& geometry, int y, OuterView& outer)
      : geometry_(geometry),
        y_(y),
        outer_(outer),
        surface_(outer.disparity.row(y)),
        mask_(outer.uncovered.row(y)),
        width_(outer.disparity.width()) {}

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
  /// Whether an eye would see the surface there, if it had this disparity. Neither does, or the photographs would show
  /// it.
  bool is_seen(int x, float disparity, ViewPosition eye, const ImageView<const float>& nearest) const {
    const float there = static_cast<float>(x + outer_.left_px) + 0.5f - (eye - outer_.position) * disparity;
    const int column = static_cast<int>(std::floor(there));
    return nearest.contains(column, y_) && nearest(column, y_) < disparity - one_surface_px;
  }

  bool may_have(const UnseenRun& run, float disparity) const {
    constexpr int most_seen = 20;  // of which one may be seen: disparities have noise
    int seen = 0;
    for (int x = run.begin; x < run.end; ++x)
      if (is_seen(x, disparity, left_eye, geometry_.left_disparity) ||
          is_seen(x, disparity, right_eye, geometry_.right_disparity))
        ++seen;
    return most_seen * seen <= run.end - run.begin;
  }

  /// The column of the nearest known surface beside a run that may go on in it, seen by no eye; of the farthest one
  /// where there is none such; -1 where nothing is known.
  int source_of(const UnseenRun& run) const {
    int farthest = -1;
    for (int away = 1; away <= width_; ++away) {
      for (const int x : {run.begin - away, run.end - 1 + away}) {
        constexpr float as_near_px = 0.5f;
        if (x < 0 || x >= width_ || mask_[x] != 0) continue;
        // What is as near as something that eyes would see is seen, too.
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

  const StereoGeometryView& geometry_;
  int y_;
  OuterView& outer_;
  std::span<float> surface_;
  std::span<std::uint8_t> mask_;
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

SceneView scene_view_of(const OuterView& view) {
  return {view.picture, view.disparity, view.uncovered, view.position, view.left_px, true, view.reduction};
}

OuterView enlarged(const SceneView& view, int factor, int width, int height) {
  OuterView whole{
      view.position, Image<Rgb8>(width, height), Image<float>(width, height), Image<std::uint8_t>(width, height),
      view.left_px,  view.reduction / factor};
  const int last_column = view.picture.width() - 1, rows = view.picture.height();
  const auto end_of = [=](int row) { return row + 1 < rows ? factor * (row + 1) : height; };
  tbb::parallel_for(0, rows, [&](int row) {
    const auto picture = view.picture.row(row);
    const auto disparity = view.disparity.row(row);
    const auto uncovered = view.only_here.row(row);
    const int first = factor * row;
    const auto to_picture = whole.picture.row(first);
    const auto to_disparity = whole.disparity.row(first);
    const auto to_uncovered = whole.uncovered.row(first);
    for (int column = 0, x = 0; column <= last_column; ++column) {
      const float larger = disparity[column] * static_cast<float>(factor);
      for (const int end = column < last_column ? x + factor : width; x < end; ++x) {
        to_picture[x] = picture[column];
        to_disparity[x] = larger;
        to_uncovered[x] = uncovered[column];
      }
    }
    for (int y = first + 1; y < end_of(row); ++y) {
      std::ranges::copy(to_picture, whole.picture.row(y).begin());
      std::ranges::copy(to_disparity, whole.disparity.row(y).begin());
      std::ranges::copy(to_uncovered, whole.uncovered.row(y).begin());
    }
  });
  return whole;
}

WholeScene::WholeScene(std::span<const SceneView> views) : views_(views.begin(), views.end()) {
  const ImageView<const Rgb8> reference = views.front().picture;
  larger_.reserve(views.size());
  for (SceneView& view : views_)
    if (view.reduction > 1)
      view = scene_view_of(larger_.emplace_back(enlarged(view, view.reduction, reference.width(), reference.height())));
}

OuterView make_outer_view(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewPosition view,
                          float zero_parallax_px) {
  constexpr float lies_before_px = 1;
  const int width = photographs.left.width(), height = photographs.left.height();
  const auto left_px = static_cast<int>(std::lround(-(view - central_view) * zero_parallax_px));
  Composition seen{view, Image<Rgb8>(width, height),
                   Image<float>(width, height, std::numeric_limits<float>::quiet_NaN()), left_px};
  const auto lay_left = [&] {
    warp_picture_over(photographs.left, geometry.left_disparity, left_eye, lies_before_px, seen);
  };
  if (view < central_view) lay_left();
  warp_picture_over(photographs.right, geometry.right_disparity, right_eye, lies_before_px, seen);
  if (view >= central_view) lay_left();

  OuterView outer{view, std::move(seen.picture), std::move(seen.nearest), Image<std::uint8_t>(width, height), left_px};
  tbb::parallel_for(0, height, [&](int y) {
    const auto mask = outer.uncovered.row(y);
    const auto surface = outer.disparity.row(y);
    for (int x = 0; x < width; ++x) mask[x] = std::isnan(surface[x]) ? 255 : 0;
    RowFiller(geometry, y, outer).fill();
    leave_out_cracks(mask);
  });
  fill_from_farther_side(outer.disparity);  // rows without anything known
  return outer;
}

}  // namespace wheatstone
