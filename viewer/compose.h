#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "content.h"
#include "output_mode.h"
#include "view_state.h"
#include "wheatstone/depth/view_position.h"
#include "wheatstone/image/image.h"

namespace wheatstone::viewer {

/// The place in which a picture is shown: of a window, on its screen.
struct Viewport {
  int width = 0, height = 0;       ///< pixels
  int screen_x = 0, screen_y = 0;  ///< of its upper left pixel on the screen
  friend bool operator==(const Viewport&, const Viewport&) = default;
};

/// Where a view lies in a frame: pixel (x, y) of the view at frame pixel
/// left + squeeze_x · (origin_x + scale · x), top + squeeze_y · (origin_y + scale · y), but for the eyes' roll.
struct ViewPlace {
  ViewPosition view;
  int left = 0, top = 0, width = 0, height = 0;  ///< of the frame, that shows the view
  double squeeze_x = 1, squeeze_y = 1;           ///< ½ where half of an eye's pixels are left out
  double scale = 1;
  double origin_x = 0, origin_y = 0;
};

/// A place in a view, in its own pixels.
struct PlaceInView {
  ViewPosition view;
  double x = 0, y = 0;
};

/// What lies at a pixel of a frame; none beside the views.
std::optional<PlaceInView> place_at(const std::vector<ViewPlace>& places, double x, double y);

/// A point of a picture or frame, in its pixels.
struct FramePoint {
  float x = 0, y = 0;
};

/// A slicing plane beside a painting's layers, drawn as a frame.
struct PlaneFrame {
  std::array<FramePoint, 4> corners;  ///< in their order around it
  FramePoint way;                     ///< from where it lies at the nearest stroke to where it lies at the farthest
};

/// Which of the planes has a line at a place; none where there is no line within a few pixels.
std::optional<std::size_t> plane_at(std::span<const PlaneFrame> planes, double x, double y);

/// A picture of what is open, as a viewport shows it.
struct Frame {
  Image<Rgb8> picture;            ///< of the viewport's size
  Image<Rgb8> right;              ///< of a page flip: `picture` is the left eye's; else empty
  std::vector<ViewPlace> places;  ///< where views lie in it; of what covers the whole frame, that of the middle view
  double scale = 1;               ///< screen pixels for one of the content
  bool preliminary = false;       ///< drawn quickly: another drawing with all effort shows more
  std::optional<Brightness> brightness;                          ///< of particles, as all of them have it
  Content shown;                                                 ///< what it shows, with its depth as it is seen
  Content placed;                                                ///< the same, without more depth where somebody looks
  std::optional<DepthEnds> depth;                                ///< of that
  std::shared_ptr<const std::vector<Image<float>>> model_depth;  ///< of the views at these positions; none: not known
  std::vector<ViewPosition> model_views;
  std::vector<PlaneFrame> planes;  ///< slicing planes that can be dragged, from that of the finest layer on
};

/// The size of the picture that each eye is to have, before a mode puts both in one.
PictureSize eye_size(const OutputMode& mode, const Viewport& viewport);

/// Puts the eyes' pictures, each of eye_size, on the screen.
Frame compose(const OutputMode& mode, Image<Rgb8> left, Image<Rgb8> right, const Viewport& viewport);

/// A picture of this size, black but for what another one covers whose upper left pixel lies at (x, y).
Image<Rgb8> laid_at(int x, int y, ImageView<const Rgb8> picture, PictureSize size);

/// The picture in the middle of the viewport, cut off or with black around it.
Image<Rgb8> centred(ImageView<const Rgb8> picture, const Viewport& viewport);

/// Where the eyes of such a frame lie in it: `left` and `right` are places in the eyes' own pictures.
std::vector<ViewPlace> places_in_frame(const OutputMode& mode, ViewPlace left, ViewPlace right,
                                       const Viewport& viewport);

}  // namespace wheatstone::viewer
