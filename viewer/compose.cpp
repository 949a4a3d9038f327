#include "compose.h"

#include <algorithm>
#include <utility>

#include "wheatstone/display/anaglyph.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone::viewer {
namespace {

const LayoutTraits* layout_of(const OutputMode& mode) {
  const auto* const layout = std::get_if<StereoLayout>(&mode.kind);
  return layout == nullptr ? nullptr : &traits_of(*layout);
}

int even(int value) { return std::max(value - value % 2, 2); }

Image<Rgb8> put_in_layout(StereoLayout layout, const Image<Rgb8>& left, const Image<Rgb8>& right,
                          const Viewport& viewport) {
  return put_together(left, right, layout_from(layout, viewport.screen_x, viewport.screen_y));
}

}  // namespace

std::optional<PlaceInView> place_at(const std::vector<ViewPlace>& places, double x, double y) {
  for (const ViewPlace& place : places) {
    if (x < place.left || y < place.top || x >= place.left + place.width || y >= place.top + place.height) continue;
    return PlaceInView{place.view, ((x - place.left) / place.squeeze_x - place.origin_x) / place.scale,
                       ((y - place.top) / place.squeeze_y - place.origin_y) / place.scale};
  }
  return {};
}

PictureSize eye_size(const OutputMode& mode, const Viewport& viewport) {
  const LayoutTraits* const layout = layout_of(mode);
  if (layout == nullptr) return {viewport.width, viewport.height};
  switch (layout->arrangement) {
    case Arrangement::side_by_side:
      return {layout->half ? even(viewport.width) : std::max(viewport.width / 2, 1), viewport.height};
    case Arrangement::over_under:
      return {viewport.width, layout->half ? even(viewport.height) : std::max(viewport.height / 2, 1)};
    default:
      return {viewport.width, viewport.height};
  }
}

Frame compose(const OutputMode& mode, Image<Rgb8> left, Image<Rgb8> right, const Viewport& viewport) {
  Frame frame;
  if (const auto* const eye = std::get_if<SingleEye>(&mode.kind)) {
    frame.picture = std::move(*eye == SingleEye::left ? left : right);
  } else if (const auto* const kind = std::get_if<const AnaglyphKind*>(&mode.kind)) {
    frame.picture = anaglyph({left, right}, **kind);
  } else if (const auto* const layout = std::get_if<StereoLayout>(&mode.kind)) {
    frame.picture = put_in_layout(*layout, left, right, viewport);
  } else {
    frame.picture = std::move(left);
    if (std::holds_alternative<PageFlip>(mode.kind)) frame.right = std::move(right);
  }
  if (frame.picture.width() != viewport.width || frame.picture.height() != viewport.height)
    frame.picture = centred(frame.picture, viewport);
  return frame;
}

Image<Rgb8> laid_at(int x, int y, ImageView<const Rgb8> picture, PictureSize size) {
  Image<Rgb8> laid(size.width, size.height);
  const int first_x = std::max(0, -x), last_x = std::min(picture.width(), size.width - x);
  for (int row = std::max(0, -y); row < std::min(picture.height(), size.height - y) && first_x < last_x; ++row)
    std::ranges::copy(picture.row(row).subspan(first_x, last_x - first_x), laid.row(y + row).begin() + x + first_x);
  return laid;
}

Image<Rgb8> centred(ImageView<const Rgb8> picture, const Viewport& viewport) {
  return laid_at((viewport.width - picture.width()) / 2, (viewport.height - picture.height()) / 2, picture,
                 {viewport.width, viewport.height});
}

std::optional<std::size_t> plane_at(std::span<const PlaneFrame> planes, double x, double y) {
  constexpr double near_px = 8;
  std::optional<std::size_t> found;
  double nearest = near_px;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    for (std::size_t corner = 0; corner < 4; ++corner) {
      const FramePoint &a = planes[i].corners[corner], &b = planes[i].corners[(corner + 1) % 4];
      const double dx = b.x - a.x, dy = b.y - a.y, px = x - a.x, py = y - a.y;
      const double along = std::clamp((px * dx + py * dy) / std::max(dx * dx + dy * dy, 1.), 0., 1.);
      const double distance = std::hypot(px - along * dx, py - along * dy);
      if (distance >= nearest) continue;
      nearest = distance;
      found = i;
    }
  }
  return found;
}

std::vector<ViewPlace> places_in_frame(const OutputMode& mode, ViewPlace left, ViewPlace right,
                                       const Viewport& viewport) {
  if (const auto* const eye = std::get_if<SingleEye>(&mode.kind)) return {*eye == SingleEye::left ? left : right};
  const LayoutTraits* const layout = layout_of(mode);
  const bool beside = layout != nullptr && layout->arrangement == Arrangement::side_by_side;
  const bool above = layout != nullptr && layout->arrangement == Arrangement::over_under;
  if (!beside && !above) {
    // Both eyes' pictures lie over each other. A place on the screen is the middle view's.
    left.view = ViewPosition((left.view.eye_separations() + right.view.eye_separations()) / 2);
    left.origin_x = (left.origin_x + right.origin_x) / 2;
    left.origin_y = (left.origin_y + right.origin_y) / 2;
    return {left};
  }
  if (layout->half) {
    (beside ? left.squeeze_x : left.squeeze_y) = 0.5;
    (beside ? right.squeeze_x : right.squeeze_y) = 0.5;
    (beside ? left.width : left.height) /= 2;
    (beside ? right.width : right.height) /= 2;
  }
  const int rest_x = (viewport.width - (beside ? 2 : 1) * left.width) / 2;
  const int rest_y = (viewport.height - (above ? 2 : 1) * left.height) / 2;
  ViewPlace& second = layout->right_first ? left : right;
  left.left = right.left = rest_x;
  left.top = right.top = rest_y;
  (beside ? second.left : second.top) += beside ? left.width : left.height;
  return {left, right};
}

}  // namespace wheatstone::viewer
