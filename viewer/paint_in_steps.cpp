#include "paint_in_steps.h"

#include <algorithm>
#include <utility>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/stereo/geometry_from_disparity.h"
#include "wheatstone/stereo/reduced_pair.h"

namespace wheatstone::viewer {
namespace {

constexpr int coarse_px = 240;

/// Every so many-th pixel's disparity, in pixels of the smaller picture.
Image<float> reduced_disparity(ImageView<const float> disparity, PictureSize size) {
  Image<float> small(size.width, size.height);
  const float scale = static_cast<float>(size.width) / static_cast<float>(disparity.width());
  for (int y = 0; y < size.height; ++y)
    for (int x = 0; x < size.width; ++x)
      small(x, y) = scale * disparity((2 * x + 1) * disparity.width() / (2 * size.width),
                                      (2 * y + 1) * disparity.height() / (2 * size.height));
  return small;
}

/// What stays the same when the picture is made smaller: lengths of a style count in pixels of a 640-pixel-wide one.
Painting coarse_painting(const Photograph& photograph, const Style& style, const Progress& progress) {
  const Image<Rgb8>& left = photograph.pictures.left;
  const PictureSize size = reduced_size({left.width(), left.height()}, coarse_px);
  const StereoPair pair{reduced(left, size), reduced(photograph.pictures.right, size)};
  const StereoGeometry geometry = geometry_from_both(reduced_disparity(photograph.geometry->left_disparity, size),
                                                     reduced_disparity(photograph.geometry->right_disparity, size));
  Painting painting = plan_painting(pair, geometry, style, progress, ViewRange{});
  return placed(std::move(painting), {.width = left.width(),
                                      .height = left.height(),
                                      .scale = static_cast<double>(left.width()) / static_cast<double>(size.width)});
}

}  // namespace

void paint_in_steps(const std::shared_ptr<const Photograph>& photograph, const Style& style, const Progress& progress,
                    const std::function<void(PaintedContent)>& deliver) {
  std::shared_ptr<const Photograph> known = photograph;
  if (!known->geometry) {
    auto found = std::make_shared<Photograph>(*photograph);
    found->geometry = find_geometry(photograph->pictures, {}, progress).geometry;
    known = std::move(found);
    deliver({nullptr, known});
  }
  const Image<Rgb8>& left = known->pictures.left;
  if (std::max(left.width(), left.height()) > 2 * coarse_px)
    deliver({std::make_shared<const Painting>(coarse_painting(*known, style, progress)), known});
  deliver({std::make_shared<const Painting>(plan_painting(known->pictures, *known->geometry, style, progress)), known});
}

}  // namespace wheatstone::viewer
