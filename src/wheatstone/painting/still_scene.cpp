#include "wheatstone/painting/still_scene.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <utility>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/image/reduced_view.h"

namespace wheatstone {

namespace {

/// How much smaller what no photograph shows may be made: as small as its finest strokes are planned.
int reduction_for(int width) {
  constexpr int halved_px = 480, quartered_px = 3840;
  return width < halved_px ? 1 : width < quartered_px ? 2 : 4;
}

/// A pair and its geometry, smaller; of the geometry only the disparities.
struct ReducedScene {
  StereoPair photographs;
  StereoGeometry geometry;
};

ReducedScene reduced_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, int reduction) {
  const auto reduce = [=](ImageView<const Rgb8> picture, ImageView<const float> disparity) {
    return reduced(picture, disparity, Image<std::uint8_t>(picture.width(), picture.height()), reduction);
  };
  ReducedView left = reduce(photographs.left, geometry.left_disparity);
  ReducedView right = reduce(photographs.right, geometry.right_disparity);
  ReducedScene scene;
  scene.photographs = {std::move(left.photograph), std::move(right.photograph)};
  scene.geometry.left_disparity = std::move(left.disparity);
  scene.geometry.right_disparity = std::move(right.disparity);
  return scene;
}

OuterView enlarged(const OuterView& view, int reduction, int width, int height) {
  OuterView whole{view.position, Image<Rgb8>(width, height), Image<float>(width, height),
                  Image<std::uint8_t>(width, height), reduction * view.left_px};
  const int last_column = view.picture.width() - 1, rows = view.picture.height();
  const auto end_of = [=](int row) { return row + 1 < rows ? reduction * (row + 1) : height; };
  tbb::parallel_for(0, rows, [&](int row) {
    const auto picture = view.picture.row(row);
    const auto disparity = view.disparity.row(row);
    const auto uncovered = view.uncovered.row(row);
    const int first = reduction * row;
    const auto to_picture = whole.picture.row(first);
    const auto to_disparity = whole.disparity.row(first);
    const auto to_uncovered = whole.uncovered.row(first);
    for (int column = 0, x = 0; column <= last_column; ++column) {
      const float larger = disparity[column] * static_cast<float>(reduction);
      for (const int end = column < last_column ? x + reduction : width; x < end; ++x) {
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

}  // namespace

std::vector<OuterView> make_outer_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                        ViewRange wanted, float zero_parallax_px) {
  std::vector<OuterView> outer;
  std::vector<float> shares{1};
  // What a view halfway uncovers, the outermost one may hide again. Large pictures would take too much memory.
  constexpr double large_px = 8e6;
  if (static_cast<double>(photographs.left.width()) * photographs.left.height() <= large_px) shares.push_back(0.5f);
  std::vector<ViewPosition> positions;
  for (const float share : shares) {
    for (const ViewPosition outermost : {wanted.first, wanted.last}) {
      const ViewPosition view(share * outermost.eye_separations());
      if (view < left_eye || view > right_eye) positions.push_back(view);
    }
  }
  const int width = photographs.left.width(), height = photographs.left.height(), reduction = reduction_for(width);
  if (reduction == 1 || height < reduction || positions.empty()) {
    for (const ViewPosition view : positions)
      outer.push_back(make_outer_view(photographs, geometry, view, zero_parallax_px));
    return outer;
  }
  const ReducedScene scene = reduced_scene(photographs, geometry, reduction);
  for (const ViewPosition view : positions)
    outer.push_back(enlarged(
        make_outer_view(scene.photographs, scene.geometry, view, zero_parallax_px / static_cast<float>(reduction)),
        reduction, width, height));
  return outer;
}

void append_views(std::span<const OuterView> outer, std::vector<SceneView>& scene) {
  for (const OuterView& view : outer)
    scene.push_back({view.picture, view.disparity, view.uncovered, view.position, view.left_px, true});
}

StillScene make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry, ViewRange wanted) {
  StillScene scene;
  scene.views = scene_from_left(photographs, geometry);
  scene.outer = make_outer_views(photographs, geometry, wanted, depth_ends(geometry.left_disparity).middle_px());
  append_views(scene.outer, scene.views);
  return scene;
}

}  // namespace wheatstone
