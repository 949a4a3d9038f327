#include "wheatstone/strokes/view_to_plan_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/stereo/occlusion.h"
#include "wheatstone/stereo/view_scale.h"
#include "wheatstone/strokes/layer_order.h"

namespace wheatstone {
namespace {

/// The scale at which the finest strokes are planned for the parts that a view alone shows.
int scale_for(const View& view, float finest_radius_px) {
  constexpr int least = 2, most = 8;
  // The parts that only views between the eyes show are slits, which need less detail.
  const bool is_between = view.position > left_eye && view.position < right_eye;
  const float least_radius_px = is_between ? 0.75f : 1.5f;
  int scale = least;
  while (view.continued && scale < most && finest_radius_px >= least_radius_px * static_cast<float>(2 * scale))
    scale *= 2;
  return scale;
}

/// 255 for the wanted pixels of a view that the reference view does not show.
Image<std::uint8_t> shown_alone(const View& view, const View& reference, float depth_threshold_px) {
  Image<std::uint8_t> alone(view.colour.width(), view.colour.height());
  const auto width = static_cast<float>(reference.colour.width());
  tbb::parallel_for(0, alone.height(), [&](int y) {
    for (int x = 0; x < alone.width(); ++x) {
      if (view.wanted(x, y) == 0) continue;
      const ControlPoint point{static_cast<float>(x + view.frame.origin_px) + 0.5f, static_cast<float>(y) + 0.5f,
                               view.disparity(x, y)};
      const float column = x_in_view(point, view.position, reference.position);
      const bool is_in_picture = column >= 0 && column < width;
      alone(x, y) =
          is_in_picture && disparity_at(reference, column, point.y) <= point.disparity + depth_threshold_px ? 0 : 255;
    }
  });
  return alone;
}

}  // namespace

View wanted_part(const View& view, const View& reference, const Style& style, bool scene_begins) {
  if (view.wanted.empty()) return view;
  const ScaledStyle scaled(style, reference.colour.width());
  View part = view;
  if (!scene_begins) {
    part.wanted = shown_alone(view, reference, scaled.depth_threshold_px);
    return part;
  }
  const int scale = scale_for(view, scaled.radii_px.back());
  if (view.frame.scale > scale)
    part = larger_view(view, view.frame.scale / scale, reference.colour.width() / scale,
                       reference.colour.height() / scale);
  const float growth_px = style.occlusion_dilation * scaled.radii_px.front();
  part.wanted =
      dilate_occlusion(part.wanted, static_cast<int>(std::lround(growth_px / static_cast<float>(part.frame.scale))));
  return part;
}

View view_to_plan(const View& part, const View& reference, const Style& style) {
  if (part.wanted.empty()) return part;
  const float finest_radius_px = ScaledStyle(style, reference.colour.width()).radii_px.back();
  return smaller_view(part, scale_for(part, finest_radius_px) / part.frame.scale);
}

namespace {

/// Finds the wanted pixels that lie before the surface of a smaller pixel; a dot stands for those of a square.
class DotsLeftOut {
 public:
  DotsLeftOut(const View& part, int factor) : part_(part), factor_(factor) {}

  /// Adds the dots within one pixel of the smaller view, which the picture's edge may cut off.
  void add(int column, int row, float surface, Layer& dots) const {
    constexpr float one_surface_px = 1;
    const int side = side_px(), left = column * factor_, top = row * factor_;
    const int right = std::min(left + factor_, part_.wanted.width());
    const int bottom = std::min(top + factor_, part_.wanted.height());
    for (int square_top = top; square_top < bottom; square_top += side) {
      for (int square_left = left; square_left < right; square_left += side) {
        ControlPoint mean;
        Rgb8 colour;
        float count = 0;
        for (int y = square_top; y < std::min(square_top + side, bottom); ++y) {
          for (int x = square_left; x < std::min(square_left + side, right); ++x) {
            if (part_.wanted(x, y) == 0 || part_.disparity(x, y) - surface <= one_surface_px) continue;
            mean.x += static_cast<float>(x) + 0.5f;
            mean.y += static_cast<float>(y) + 0.5f;
            mean.disparity = count > 0 ? std::max(mean.disparity, part_.disparity(x, y)) : part_.disparity(x, y);
            colour = part_.colour(x, y);
            ++count;
          }
        }
        if (count > 0) add_dot({mean.x / count, mean.y / count, mean.disparity}, colour, dots);
      }
    }
  }

 private:
  /// A pixel of a smaller picture stands for several already.
  int side_px() const { return part_.frame.scale > 1 ? 1 : 2; }

  void add_dot(const ControlPoint& at, Rgb8 colour, Layer& dots) const {
    const auto factor = static_cast<float>(factor_);
    const ControlPoint point{at.x / factor, at.y / factor, at.disparity / factor};
    dots.strokes.push_back({.first_point = static_cast<std::uint32_t>(dots.points.size()),
                            .point_count = 1,
                            .radius_px = static_cast<float>(side_px()) / 2 / factor,
                            .colour = colour,
                            .disparity = point.disparity,
                            .reference_view = part_.position,
                            .views = all_views});
    dots.points.push_back(point);
  }

  const View& part_;
  int factor_;
};

}  // namespace

Layer dots_left_out(const View& part, const View& smaller) {
  const int factor = smaller.frame.scale / part.frame.scale;
  const DotsLeftOut left_out(part, factor);
  Layer dots;
  if (factor == 1) return dots;
  const int width = smaller.colour.width(), height = smaller.colour.height();
  std::vector<Layer> rows(static_cast<std::size_t>(height));
  tbb::parallel_for(0, height, [&](int row) {
    for (int column = 0; column < width; ++column)
      if (smaller.wanted(column, row) != 0)
        left_out.add(column, row, smaller.disparity(column, row) * static_cast<float>(factor),
                     rows[static_cast<std::size_t>(row)]);
  });
  for (const Layer& row : rows) append_strokes(row, dots);
  // The columns and rows at the end that make no whole pixel.
  constexpr float nothing = -std::numeric_limits<float>::infinity();
  if (width * factor < part.colour.width())
    for (int row = 0; row < height; ++row) left_out.add(width, row, nothing, dots);
  if (height * factor < part.colour.height())
    for (int column = 0; column * factor < part.colour.width(); ++column) left_out.add(column, height, nothing, dots);
  return dots;
}

int factor_for_layer(const View& view, float radius_px, float least_radius_px) {
  constexpr int least_side_px = 16;
  const int side_px = std::min(view.colour.width(), view.colour.height());
  const auto fits = [&](int factor) {
    return radius_px >= least_radius_px * static_cast<float>(factor * view.frame.scale) &&
           side_px >= least_side_px * factor;
  };
  int factor = 1;
  while (fits(2 * factor)) factor *= 2;
  return factor;
}

}  // namespace wheatstone
