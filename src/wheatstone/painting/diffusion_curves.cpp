#include "wheatstone/painting/diffusion_curves.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/painting/edge_chains_internal.h"
#include "wheatstone/painting/fitting_pair_internal.h"
#include "wheatstone/painting/orientation_field_internal.h"
#include "wheatstone/painting/plan_polygons_internal.h"
#include "wheatstone/stereo/occlusion.h"

namespace wheatstone {
namespace {

/// One eye, whose edges become lines.
struct EyeAtWork {
  ImageView<const Rgb8> photograph;
  ImageView<const float> disparity;
  ImageView<const std::uint8_t> occlusion;  ///< what the other eye does not see
  float view;
  float scale;
  float depth_threshold_px;
  bool is_other;  ///< only what the first eye's lines do not show is wanted
  bool alone;     ///< no other eye takes part
};

/// In which views one point of a line is wanted.
enum class Wanted { nowhere, here, both };

Wanted wanted(const EyeAtWork& eye, bool behind, bool occluded) {
  if (eye.alone) return Wanted::here;
  if (behind) return Wanted::here;
  if (eye.is_other) return occluded ? Wanted::here : Wanted::nowhere;
  return occluded ? Wanted::here : Wanted::both;
}

/// A point of one side, and where it is to be seen.
struct SidePoint {
  ColourPoint point;
  Wanted wanted = Wanted::nowhere;
};

/// The place `offset_px` to the side of a chain's point, as a pixel of the picture.
struct PixelAt {
  int x, y;
};

class SideMaker {
 public:
  SideMaker(const EyeAtWork& eye, const Image<Rgb8>& picture) : eye_(eye), picture_(picture) {}

  /// One side of a chain, +1 or −1: each second point, with colour and disparity of the surface there.
  std::vector<SidePoint> make(const std::vector<PlanePoint>& chain, float side) const {
    std::vector<SidePoint> points;
    const std::size_t last = chain.size() - 1;
    for (std::size_t i = 0; i <= last; i += (i + 2 > last && i < last ? last - i : 2)) {
      const PlanePoint &before = chain[i < 2 ? 0 : i - 2], &after = chain[std::min(i + 2, last)];
      const float dx = after.x - before.x, dy = after.y - before.y, length = std::hypot(dx, dy);
      if (length <= 0) continue;
      points.push_back(at(chain[i], {-side * dy / length, side * dx / length}));
    }
    return points;
  }

 private:
  PixelAt pixel(PlanePoint p, Direction across, float offset_px) const {
    return {std::clamp(static_cast<int>(p.x + offset_px * across.x), 0, picture_.width() - 1),
            std::clamp(static_cast<int>(p.y + offset_px * across.y), 0, picture_.height() - 1)};
  }

  SidePoint at(PlanePoint p, Direction across) const {
    // Colours right on the edge are mixed: they are taken a little farther out than the line lies.
    constexpr float line_px = 1, colour_px = 2.2f;
    const PixelAt here = pixel(p, across, colour_px), there = pixel(p, across, -colour_px);
    const float own = eye_.disparity(here.x, here.y), other = eye_.disparity(there.x, there.y);
    SidePoint result;
    result.point.at = {p.x + line_px * across.x, p.y + line_px * across.y, own};
    result.point.colour = picture_(here.x, here.y);
    result.wanted = wanted(eye_, other - own > eye_.depth_threshold_px, eye_.occlusion(here.x, here.y) != 0);
    return result;
  }

  const EyeAtWork& eye_;
  const Image<Rgb8>& picture_;
};

/// Adds the runs of a side that are wanted in the same views.
void add_lines(const EyeAtWork& eye, const std::vector<SidePoint>& side, DiffusionPainting& painting) {
  for (std::size_t begin = 0; begin < side.size();) {
    std::size_t end = begin + 1;
    const auto joins = [&](std::size_t i) {
      return side[i].wanted == side[begin].wanted &&
             std::abs(side[i].point.at.disparity - side[i - 1].point.at.disparity) <= eye.depth_threshold_px;
    };
    while (end < side.size() && joins(end)) ++end;
    if (side[begin].wanted != Wanted::nowhere) {
      ColourLine line{
          static_cast<std::uint32_t>(painting.points.size()), static_cast<std::uint32_t>(end - begin), eye.view, {}};
      if (side[begin].wanted == Wanted::here) line.views = {eye.view, eye.view};
      for (std::size_t i = begin; i < end; ++i) painting.points.push_back(side[i].point);
      painting.lines.push_back(line);
    }
    begin = end;
  }
}

void add_eye(const EyeAtWork& eye, DiffusionPainting& painting) {
  const Image<Rgb8> picture = without_grain(eye.photograph, eye.scale);
  const SideMaker sides(eye, picture);
  for (const auto& chain : find_edge_chains(picture, eye.disparity, {.depth_threshold_px = eye.depth_threshold_px}))
    for (const float side : {1.f, -1.f}) add_lines(eye, sides.make(chain, side), painting);
}

/// A picture without edges still has a colour.
void add_middle(const EyeAtWork& eye, DiffusionPainting& painting) {
  const int x = painting.width / 2, y = painting.height / 2;
  painting.lines.push_back({static_cast<std::uint32_t>(painting.points.size()), 1, eye.view, {eye.view, eye.view}});
  painting.points.push_back(
      {{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, eye.disparity(x, y)}, eye.photograph(x, y)});
}

}  // namespace

DiffusionPainting plan_diffusion(const StereoPair& photographs, const StereoGeometry& geometry, const Style& style) {
  check_style(style);
  check_fits(photographs, geometry);
  const Image<float> left_disparity = without_outliers(geometry.left_disparity);
  const Image<float> right_disparity = without_outliers(geometry.right_disparity);
  const Image<std::uint8_t> right_only = dilate_occlusion(geometry.right_occlusion, 1);
  const float scale = style_scale(style, photographs.left.width());
  const bool alone = style.propagation == Propagation::independent;
  const EyeAtWork left{photographs.left,
                       left_disparity,
                       geometry.left_occlusion,
                       left_eye,
                       scale,
                       style.depth_threshold_px * scale,
                       false,
                       alone};
  const EyeAtWork right{
      photographs.right, right_disparity, right_only, right_eye, scale, style.depth_threshold_px * scale, true, alone};
  DiffusionPainting painting{photographs.left.width(), photographs.left.height(), {}, {}};
  add_eye(left, painting);
  add_eye(right, painting);
  for (const EyeAtWork* eye : {&left, &right}) {
    const auto shows = [&](const ColourLine& line) { return line.views.contains(eye->view); };
    if (std::ranges::none_of(painting.lines, shows)) add_middle(*eye, painting);
  }
  return painting;
}

}  // namespace wheatstone
