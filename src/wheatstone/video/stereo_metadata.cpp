#include "wheatstone/video/stereo_metadata_internal.h"

#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {
namespace {

Arrangement arrangement_of(AVStereo3DType type) {
  switch (type) {
    case AV_STEREO3D_SIDEBYSIDE:
    case AV_STEREO3D_SIDEBYSIDE_QUINCUNX:
      return Arrangement::side_by_side;
    case AV_STEREO3D_TOPBOTTOM:
      return Arrangement::over_under;
    case AV_STEREO3D_FRAMESEQUENCE:
      return Arrangement::in_time;
    case AV_STEREO3D_CHECKERBOARD:
      return Arrangement::checkerboard;
    case AV_STEREO3D_LINES:
      return Arrangement::rows;
    case AV_STEREO3D_COLUMNS:
      return Arrangement::columns;
    default:
      return Arrangement::whole;
  }
}

bool is_squeezed(Arrangement arrangement, int width, int height, AVRational pixel_aspect) {
  if (pixel_aspect.num > 0 && pixel_aspect.den > 0 && pixel_aspect.num != pixel_aspect.den) {
    const double aspect = av_q2d(pixel_aspect);
    return arrangement == Arrangement::side_by_side ? aspect > 1.5 : aspect < 1 / 1.5;
  }
  const double proportions = static_cast<double>(width) / height;
  return height >= 720 && proportions > 1.7 && proportions < 1.8;
}

}  // namespace

StereoLayout layout_of(const AVStereo3D& stereo, int width, int height, AVRational pixel_aspect) {
  const Arrangement arrangement = arrangement_of(stereo.type);
  bool right_first = (stereo.flags & AV_STEREO3D_FLAG_INVERT) != 0;
  if (stereo.view != AV_STEREO3D_VIEW_PACKED) {
    // Only the first of two frames says which eye it is.
    if (arrangement != Arrangement::in_time) return StereoLayout::mono;
    right_first = stereo.view == AV_STEREO3D_VIEW_RIGHT;
  }
  return layout_with(arrangement, right_first, is_squeezed(arrangement, width, height, pixel_aspect));
}

std::optional<AVStereo3D> stereo_of(StereoLayout layout) {
  const LayoutTraits& traits = traits_of(layout);
  AVStereo3D stereo{};
  stereo.flags = traits.right_first ? AV_STEREO3D_FLAG_INVERT : 0;
  stereo.view = AV_STEREO3D_VIEW_PACKED;
  switch (traits.arrangement) {
    case Arrangement::whole:
      return {};
    case Arrangement::side_by_side:
      stereo.type = AV_STEREO3D_SIDEBYSIDE;
      break;
    case Arrangement::over_under:
      stereo.type = AV_STEREO3D_TOPBOTTOM;
      break;
    case Arrangement::rows:
      stereo.type = AV_STEREO3D_LINES;
      break;
    case Arrangement::columns:
      stereo.type = AV_STEREO3D_COLUMNS;
      break;
    case Arrangement::checkerboard:
      stereo.type = AV_STEREO3D_CHECKERBOARD;
      break;
    case Arrangement::in_time:
      stereo.type = AV_STEREO3D_FRAMESEQUENCE;
      break;
  }
  return stereo;
}

Rational pixel_aspect_of(StereoLayout layout) {
  const LayoutTraits& traits = traits_of(layout);
  if (traits.half && traits.arrangement == Arrangement::side_by_side) return {2, 1};
  if (traits.half && traits.arrangement == Arrangement::over_under) return {1, 2};
  return {1, 1};
}

std::optional<int> frame_packing_of(StereoLayout layout) {
  const LayoutTraits& traits = traits_of(layout);
  if (traits.right_first) return {};
  switch (traits.arrangement) {
    case Arrangement::checkerboard:
      return 0;
    case Arrangement::columns:
      return 1;
    case Arrangement::rows:
      return 2;
    case Arrangement::side_by_side:
      return 3;
    case Arrangement::over_under:
      return 4;
    case Arrangement::in_time:
      return 5;
    default:
      return {};
  }
}

}  // namespace wheatstone
