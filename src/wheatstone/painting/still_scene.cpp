#include "wheatstone/painting/still_scene.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <span>
#include <utility>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/depth/warp_row.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/view_scale.h"

namespace wheatstone {

namespace {

/// How many times smaller parts that no photograph shows may be made: as small as their finest strokes are planned.
int scale_for(int width) {
  constexpr int halved_px = 480, quartered_px = 1920;
  return width < halved_px ? 1 : width < quartered_px ? 2 : 4;
}

/// The outermost of the wanted views, as far as they are beside the eyes, and views halfway there.
std::vector<ViewPosition> positions_beside_eyes(ImageView<const Rgb8> photograph, ViewRange wanted) {
  std::vector<float> shares{1};
  // The outermost view may hide parts that a view halfway uncovers.
  if (!is_large({photograph.width(), photograph.height()})) shares.push_back(0.5f);
  std::vector<ViewPosition> positions;
  for (const float share : shares) {
    for (const ViewPosition outermost : {wanted.first, wanted.last}) {
      const ViewPosition view(share * outermost.eye_separations());
      if (view < left_eye || view > right_eye) positions.push_back(view);
    }
  }
  return positions;
}

/// Whether a view beyond another view also shows an uncovered pixel of that view, and as an uncovered one.
bool shows(const View& beyond, const View& view, int x, int y) {
  constexpr float one_surface_px = 1;
  const float disparity = view.disparity(x, y);
  const int apart_px = (view.frame.origin_px - beyond.frame.origin_px) / view.frame.scale;
  const float place = static_cast<float>(x + apart_px) + 0.5f - (beyond.position - view.position) * disparity;
  const int column = floor_of(place);
  return beyond.wanted.contains(column, y) && beyond.wanted(column, y) != 0 &&
         std::abs(beyond.disparity(column, y) - disparity) <= one_surface_px;
}

/// Removes from each view the parts that a view beyond it uncovers, too: they would be painted twice.
void leave_out_what_others_uncover(std::vector<View>& outer) {
  for (View& view : outer) {
    Image<std::uint8_t> uncovered = copy_of(view.wanted);
    for (const View& beyond : outer) {
      const bool is_beyond = view.position > central_view
                                 ? beyond.position > view.position
                                 : view.position < central_view && beyond.position < view.position;
      if (!is_beyond) continue;
      tbb::parallel_for(0, uncovered.height(), [&](int y) {
        for (int x = 0; x < uncovered.width(); ++x)
          if (uncovered(x, y) != 0 && shows(beyond, view, x, y)) uncovered(x, y) = 0;
      });
    }
    view.wanted = std::move(uncovered);
  }
}

/// Views that are made smaller than the photographs where these are large.
std::vector<View> make_views_at(std::span<const ViewPosition> positions, std::span<const View> photographs,
                                float zero_parallax_px) {
  std::vector<View> eyes, outer;
  const int scale = scale_for(photographs[0].colour.width());
  for (const View& photograph : photographs) {
    View& eye = eyes.emplace_back(photograph);
    eye.wanted = {};
    if (!positions.empty() && photograph.colour.height() >= scale) eye = smaller_view(eye, scale);
  }
  for (const ViewPosition position : positions) outer.push_back(make_outer_view(eyes, position, zero_parallax_px));
  leave_out_what_others_uncover(outer);
  return outer;
}

/// Whether another view shows the point that a view has at a pixel. Both are of the reference view's scale.
bool shows_point(const View& other, const View& view, int x, int y) {
  constexpr float one_surface_px = 1;
  const float disparity = view.disparity(x, y);
  const float place = static_cast<float>(x) + 0.5f - (other.position - view.position) * disparity;
  // On steep surfaces a point lies between two pixels of different disparity.
  const int column = floor_of(place), beside = place - std::floor(place) < 0.5f ? column - 1 : column + 1;
  const auto is_near = [&](float one, float another) { return std::abs(one - another) <= one_surface_px; };
  if (!other.disparity.contains(column, y)) return false;
  const float here = other.disparity(column, y);
  if (is_near(here, disparity)) return true;
  if (!other.disparity.contains(beside, y)) return false;
  const float next = other.disparity(beside, y);
  // Between them only where they are one surface.
  constexpr float steepest_px = 2;
  return std::abs(here - next) <= steepest_px && disparity >= std::min(here, next) - one_surface_px &&
         disparity <= std::max(here, next) + one_surface_px;
}

/// 255 for pixels that only the right eye sees, and for gaps that the left eye's surfaces leave in the right eye's
/// view, because the disparities of the two eyes, and filled ones, do not always fit together.
Image<std::uint8_t> not_told_by_left(const StereoGeometryView& geometry) {
  const int width = geometry.left_disparity.width(), height = geometry.left_disparity.height();
  Image<std::uint8_t> mask(width, height);
  tbb::parallel_for(tbb::blocked_range<int>(0, height), [&](const tbb::blocked_range<int>& rows) {
    std::vector<float> nearest(static_cast<std::size_t>(width));
    for (int y = rows.begin(); y < rows.end(); ++y) {
      std::ranges::fill(nearest, std::numeric_limits<float>::quiet_NaN());
      warp_disparity_row_over(geometry.left_disparity.row(y), right_eye - left_eye, 0, nearest,
                              Landing::edges_and_surfaces);
      close_cracks(nearest);
      const auto occlusion = geometry.right_occlusion.row(y);
      const auto to = mask.row(y);
      for (int x = 0; x < width; ++x) to[x] = occlusion[x] != 0 || std::isnan(nearest[x]) ? 255 : 0;
    }
  });
  constexpr int least_px = 4;  // disparities have noise
  remove_occlusion_specks(mask, least_px);
  return mask;
}

/// The disparity of a pixel of the right eye that the left eye does not see, lowered until it lies before nothing that
/// the left eye shows. `left` is the left eye's disparity in the same row.
float disparity_out_of_sight(std::span<const float> left, int x, float disparity) {
  const float tolerance_px = GeometryOptions().occlusion_tolerance_px;
  for (;;) {
    const float column = std::floor(static_cast<float>(x) + 0.5f + disparity);
    if (!(column >= 0 && column < static_cast<float>(left.size()))) return disparity;
    const float shown = left[static_cast<std::size_t>(column)];
    if (shown >= disparity - tolerance_px) return disparity;
    disparity = shown;
  }
}

/// The right eye's disparity, lowered where `mask` is set, that is, on parts that only the right eye sees. Otherwise
/// their paint would lie before the left eye's surfaces, and cover them in the left eye's view.
Image<float> hidden_from_left(const StereoGeometryView& geometry, ImageView<const std::uint8_t> mask) {
  const int width = mask.width();
  Image<float> disparity(width, mask.height());
  tbb::parallel_for(0, mask.height(), [&](int y) {
    const auto marks = mask.row(y);
    const auto left = geometry.left_disparity.row(y);
    const auto to = disparity.row(y);
    std::ranges::copy(geometry.right_disparity.row(y), to.begin());
    for (int x = 0; x < width; ++x)
      if (marks[x] != 0) to[x] = disparity_out_of_sight(left, x, to[x]);
  });
  return disparity;
}

}  // namespace

std::vector<View> make_outer_views(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                   ViewRange wanted, float zero_parallax_px) {
  std::vector<View> outer = make_views_at(positions_beside_eyes(photographs.left, wanted),
                                          scene_from_left(photographs, geometry), zero_parallax_px);
  for (View& view : outer)
    view = larger_view(view, view.frame.scale, photographs.left.width(), photographs.left.height());
  return outer;
}

std::vector<View> make_still_scene(const StereoPairView& photographs, const StereoGeometryView& geometry,
                                   ViewRange wanted) {
  if (photographs.right.empty()) return {{photographs.left, geometry.left_disparity, {}, central_view}};
  std::vector<View> scene = scene_from_left(photographs, geometry);
  Image<std::uint8_t> right_only = not_told_by_left(geometry);
  scene[1].disparity = hidden_from_left(geometry, right_only);
  scene[1].wanted = std::move(right_only);
  // Between two near things the eyes see different parts of what is behind, and views between them see the rest. What
  // the eyes need stands before the outer views, whose number depends on what is wanted.
  std::vector<ViewPosition> positions;
  if (!is_large({photographs.left.width(), photographs.left.height()})) positions.push_back(central_view);
  std::ranges::copy(positions_beside_eyes(photographs.left, wanted), std::back_inserter(positions));
  const std::vector<View> outer = make_views_at(positions, scene, depth_ends(geometry.left_disparity).middle_px());
  scene.insert(scene.end(), outer.begin(), outer.end());
  return scene;
}

std::vector<View> make_known_scene(const StereoPairView& pictures, const StereoGeometryView& geometry,
                                   std::span<const View> others) {
  std::vector<View> scene{{pictures.left, geometry.left_disparity, {}, left_eye}};
  scene.insert(scene.end(), others.begin(), others.end());
  return scene;
}

void want_what_others_do_not_show(std::span<View> views) {
  for (std::size_t v = 1; v < views.size(); ++v) {
    View& view = views[v];
    Image<std::uint8_t> wanted(view.disparity.width(), view.disparity.height());
    tbb::parallel_for(0, wanted.height(), [&](int y) {
      for (int x = 0; x < wanted.width(); ++x)
        wanted(x, y) =
            std::ranges::any_of(views.first(v), [&](const View& before) { return shows_point(before, view, x, y); })
                ? 0
                : 255;
    });
    constexpr int least_px = 4;
    remove_occlusion_specks(wanted, least_px);
    view.wanted = std::move(wanted);
  }
}

}  // namespace wheatstone
