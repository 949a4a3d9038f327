#include "wheatstone/app/paint_views.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/depth/convergence.h"
#include "wheatstone/error.h"
#include "wheatstone/painting/other_views.h"
#include "wheatstone/stereo/framed_pair.h"
#include "wheatstone/strokes/wide_painting.h"

namespace wheatstone {
namespace {

/// The scene's nearest and farthest disparities, but for outliers.
struct DepthEnds {
  float farthest, nearest;
};

DepthEnds range_of(const Image<float>& disparity) {
  constexpr double outliers = 0.02;
  return {disparity_percentile(disparity, outliers), disparity_percentile(disparity, 1 - outliers)};
}

/// Of the width of a view, how much the outermost views may be apart.
float span_for(const PaintViewsOptions& options, const DepthEnds& range, float scale) {
  if (options.span > 0) return options.span;
  const float depth_px = std::max((range.nearest - range.farthest) * scale, 1.f);
  return std::min(options.depth_share * static_cast<float>(options.width) / depth_px, options.widest_span);
}

Image<Rgb8> middle_of(const Image<Rgb8>& picture, int margin) {
  Image<Rgb8> middle(picture.width() - 2 * margin, picture.height());
  for (int y = 0; y < middle.height(); ++y)
    std::ranges::copy(picture.row(y).subspan(margin, middle.width()), middle.row(y).begin());
  return middle;
}

}  // namespace

PaintedViews paint_views(const StereoPair& photographs, const PaintViewsOptions& options, const Progress& progress) {
  if (options.views < 1) throw Error(ErrorKind::wrong_usage, "there are 0 views, expected at least 1");
  check_style(options.painting.style);
  const FoundGeometry found = find_geometry(photographs, options.painting, progress);
  const StereoGeometry& geometry = found.geometry;
  const DepthEnds range = range_of(geometry.left_disparity);
  const ZeroParallax& wanted = options.painting.zero_parallax;

  PaintedViews result;
  result.confidence = found.confidence;
  result.zero_parallax_px =
      wanted.disparity_px || wanted.at ? screen_disparity(wanted, geometry) : (range.nearest + range.farthest) / 2;
  const float fill = std::max(static_cast<float>(options.width) / static_cast<float>(photographs.left.width()),
                              static_cast<float>(options.height) / static_cast<float>(photographs.left.height()));
  result.span = span_for(options, range, fill);
  result.rig = evenly_spaced(options.width, options.height, options.views, result.span);
  const ViewPosition first(-result.span / 2), last(result.span / 2);
  const float farthest_moved =
      fill * (last - central_view) *
      std::max(range.nearest - result.zero_parallax_px, result.zero_parallax_px - range.farthest);
  const FramedPair pair = framed(photographs, geometry,
                                 {.zero_parallax_px = result.zero_parallax_px,
                                  .width = options.width,
                                  .height = options.height,
                                  .margin_px = static_cast<int>(std::ceil(std::max(farthest_moved, 0.f)))});
  const Style& style = options.painting.style;
  Painting painting = plan_painting(pair.photographs, pair.geometry, style, progress);
  std::vector<DrawnView> views;
  report(progress, "views", 0);
  if (style.marks == Marks::strokes) {
    const WidePainting wide = widen(std::move(painting.strokes), pair.photographs, pair.geometry, style,
                                    {std::min(first, left_eye), std::max(last, right_eye)});
    views = draw_views(wide, result.rig.positions);
  } else {
    views = draw_other_views(painting, result.rig.positions);
  }
  for (DrawnView& view : views) {
    result.worst_bare_share = std::max(result.worst_bare_share, view.bare_share);
    result.views.push_back(middle_of(view.picture, pair.margin_px));
  }
  report(progress, "views", 1);
  return result;
}

}  // namespace wheatstone
