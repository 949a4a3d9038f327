#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/shared_image.h"
#include "wheatstone/stereo/central_view.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// The place of a view's pictures in pixels of the reference view, in which all marks stand.
struct ViewFrame {
  int origin_px = 0;  ///< column at which the pictures begin
  int scale = 1;      ///< width and height there of one of their pixels

  /// Converts a place from pixels of the reference view to pixels of the pictures.
  float column(float x) const { return (x - static_cast<float>(origin_px)) / static_cast<float>(scale); }
  float row(float y) const { return y / static_cast<float>(scale); }
  friend bool operator==(const ViewFrame&, const ViewFrame&) = default;
};

/// The value of View::detail for places that are painted as finely as the style says.
inline constexpr std::uint8_t even_detail = 128;

/// One view of a scene: an eye's, the central one, or one beside the eyes; whole, or with a mask of what is wanted of
/// it. Its images are of one size, in its own pixels. A scene is a list of views, the reference view first: it is
/// whole, and its frame is the default one. In the others, the parts that the reference view does not show are wanted.
struct View {
  SharedImage<Rgb8> colour;
  SharedImage<float> disparity;      ///< in the view's pixels, at full eye separation; no unknowns
  SharedImage<std::uint8_t> wanted;  ///< not 0 for the pixels that marks are wanted for; empty: all
  ViewPosition position = central_view;
  ViewFrame frame = {};
  bool continued = false;  ///< no photograph shows its wanted parts: they lie behind everything that an eye sees
  SharedImage<std::uint8_t> detail = {};  ///< how finely to paint, 0..255; empty: even_detail everywhere
};

/// The left eye as reference view, and what only the right one sees. Borrows its images.
std::vector<View> scene_from_left(const StereoPairView& pair, const StereoGeometryView& geometry);

/// The central view as reference, and what only the left and only the right eye sees. Borrows its images.
std::vector<View> scene_from_centre(const CentralView& centre, const StereoPairView& pair,
                                    const StereoGeometryView& geometry);

/// The disparity, in pixels of the reference view, of the surface that a view shows at a place in pixels of the
/// reference view; beyond the border, that of the border.
float disparity_at(const View& view, float x, float y);

}  // namespace wheatstone
