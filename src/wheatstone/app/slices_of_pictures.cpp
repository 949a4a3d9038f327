#include "wheatstone/app/slices_of_pictures.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/app/display_views.h"
#include "wheatstone/image/colour.h"
#include "wheatstone/multiview/cropped_slice.h"

namespace wheatstone {
namespace {

/// Planes of equal distance, the nearest first.
struct Planes {
  float nearest_px = 0, step_px = 1;
  int count = 1;

  int of(float disparity_px) const {
    return std::clamp(static_cast<int>(std::lround((nearest_px - disparity_px) / step_px)), 0, count - 1);
  }
  float disparity_px(int plane) const { return nearest_px - step_px * static_cast<float>(plane); }
};

Planes planes_for(const Surfaces& surfaces) {
  constexpr int most = 64;
  float nearest = -INFINITY, farthest = INFINITY;
  for (const Surface& surface : surfaces.seen)
    for (const float disparity : surface.disparity.values()) {
      nearest = std::max(nearest, disparity);
      farthest = std::min(farthest, disparity);
    }
  if (!(nearest >= farthest)) return {};
  const float range = nearest - farthest;
  const int count = std::min(static_cast<int>(std::ceil(range)) + 1, most);
  return {nearest, count > 1 ? range / static_cast<float>(count - 1) : 1, count};
}

/// The farthest plane in which a pixel of a run must lie so that its surface stays closed: that of what it goes on to
/// within so many pixels as planes move apart between one plane and the next.
int last_plane(std::span<const float> run, std::size_t at, const Planes& planes) {
  constexpr std::size_t reach = 3;
  constexpr float goes_on_px = 2;  // from one pixel to the next
  float farthest = run[at];
  for (const int side : {-1, 1}) {
    float last = run[at];
    for (std::size_t i = 1; i <= reach; ++i) {
      const std::size_t beside = side < 0 ? at - i : at + i;  // before the first, it is larger than any
      if (beside >= run.size() || std::abs(run[beside] - last) > std::max(goes_on_px, planes.step_px)) break;
      last = run[beside];
      farthest = std::min(farthest, last);
    }
  }
  return planes.of(farthest);
}

class Slicer {
 public:
  Slicer(const Surfaces& surfaces, std::span<const Image<Rgb8>> pictures, const Planes& planes)
      : surfaces_(surfaces), pictures_(pictures), planes_(planes) {
    float farthest = 0;  // that anything is from its column in the central view
    for (const Surface& surface : surfaces.seen)
      for (const int plane : {0, planes.count - 1})
        farthest = std::max(farthest, std::abs((surface.view - central_view) * planes.disparity_px(plane)));
    const int width = pictures.front().width();
    margin_ = static_cast<int>(std::ceil(std::min(farthest + 1, static_cast<float>(width))));
  }

  Slice slice(int plane) const {
    const Image<Rgb8>& reference = pictures_.front();
    Image<LinearRgba> pixels(reference.width() + 2 * margin_, reference.height());
    for (std::size_t i = 0; i < surfaces_.seen.size(); ++i) lay(surfaces_.seen[i], pictures_[i], plane, pixels);
    go_on_behind(plane, pixels);
    Slice slice = cropped_slice(pixels.width(), pixels.height(), [&](int x, int y) { return pixels(x, y); });
    slice.left -= margin_;
    return slice;
  }

 private:
  /// The column of a plane in which the first column of a surface lies.
  int first_column(const Surface& surface, int plane) const {
    constexpr float most_px = 1 << 20;  // more leaves every picture
    const float shift_px = (surface.view - central_view) * planes_.disparity_px(plane);
    return surface.left_px + margin_ + static_cast<int>(std::lround(std::clamp(shift_px, -most_px, most_px)));
  }

  /// What surfaces before this one in the list tell stays: they are seen first.
  void lay(const Surface& surface, const Image<Rgb8>& picture, int plane, Image<LinearRgba>& to) const {
    const int first = first_column(surface, plane);
    for (int y = 0; y < std::min(surface.disparity.height(), to.height()); ++y)
      for (const KnownRuns::Run& run : surface.disparity.runs_of(y)) {
        const std::span<const float> values = surface.disparity.values_of(run);
        for (std::size_t i = 0; i < values.size(); ++i) {
          const int own = planes_.of(values[i]);
          if (own > plane || (own < plane && last_plane(values, i, planes_) < plane)) continue;
          const int x = run.begin + static_cast<int>(i), column = first + x;
          if (column < 0 || column >= to.width() || to(column, y).a > 0) continue;
          const Rgb8 colour = picture(x, y);
          to(column, y) = {linear_from_srgb(colour.r), linear_from_srgb(colour.g), linear_from_srgb(colour.b), 1};
        }
      }
  }

  /// What lies in a plane goes on by some pixels behind what the reference view sees before it: where the parts that
  /// other views tell begin, rounding would leave gaps.
  void go_on_behind(int plane, Image<LinearRgba>& to) const {
    constexpr int reach = 4;
    const KnownRuns& reference = surfaces_.seen.front().disparity;
    const int first = first_column(surfaces_.seen.front(), plane);
    std::vector<float> seen(static_cast<std::size_t>(reference.width()));
    for (int y = 0; y < std::min(reference.height(), to.height()); ++y) {
      reference.copy_row(y, seen);
      const std::span<LinearRgba> row = to.row(y);
      const auto is_behind = [&](int column) {
        const int x = column - first;
        return x < 0 || x >= reference.width() || planes_.of(seen[static_cast<std::size_t>(x)]) < plane;
      };
      const auto go_on = [&](int column, int step) {
        const LinearRgba colour = row[static_cast<std::size_t>(column - step)];
        for (int i = 0; i < reach && column >= 0 && column < to.width(); ++i, column += step) {
          LinearRgba& here = row[static_cast<std::size_t>(column)];
          if (here.a > 0 || !is_behind(column)) return;
          here = colour;
        }
      };
      for (int x = to.width() - 2; x >= 0; --x)
        if (row[static_cast<std::size_t>(x)].a > 0 && row[static_cast<std::size_t>(x) + 1].a == 0) go_on(x + 1, 1);
      for (int x = 1; x < to.width(); ++x)
        if (row[static_cast<std::size_t>(x)].a > 0 && row[static_cast<std::size_t>(x) - 1].a == 0) go_on(x - 1, -1);
    }
  }

  const Surfaces& surfaces_;
  std::span<const Image<Rgb8>> pictures_;
  Planes planes_;
  int margin_ = 0;
};

}  // namespace

SliceStack slices_of(const PicturesOnSurfaces& scene, std::optional<float> zero_parallax_px) {
  check_has_surfaces(scene.surfaces);
  const Planes planes = planes_for(scene.surfaces);
  const float zero_px = zero_parallax_px.value_or((planes.nearest_px + planes.disparity_px(planes.count - 1)) / 2);
  const ViewRange known = known_views(scene.surfaces);
  const Image<Rgb8>& reference = scene.pictures.front();
  SliceStack stack{.width = reference.width(),
                   .height = reference.height(),
                   .span = 2 * std::min(central_view - known.first, known.last - central_view),
                   .tone = {.look = Look::thesis, .exposure = 1, .stretch = Stretch::linear},
                   .viewing = {.width_px = reference.width()},
                   .slices = std::vector<Slice>(static_cast<std::size_t>(planes.count))};
  const Slicer slicer(scene.surfaces, scene.pictures, planes);
  tbb::parallel_for(0, planes.count, [&](int plane) {
    Slice& slice = stack.slices[static_cast<std::size_t>(plane)];
    slice = slicer.slice(plane);
    slice.parallax_px = zero_px - planes.disparity_px(plane);
  });
  std::erase_if(stack.slices, [](const Slice& slice) { return slice.pixels.empty(); });
  stack.hiding = hiding_of(stack);
  return stack;
}

}  // namespace wheatstone
