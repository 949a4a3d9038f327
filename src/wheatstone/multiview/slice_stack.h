#pragma once

#include <optional>
#include <vector>

#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/image/image.h"
#include "wheatstone/multiview/tone.h"

namespace wheatstone {

/// Linear light, premultiplied by alpha; or of mass (tone.h), red is light, and green light times what it shows.
/// Glowing particles have alpha 0: laid over another they add to it.
struct LinearRgba {
  float r = 0, g = 0, b = 0, a = 0;
  friend bool operator==(const LinearRgba&, const LinearRgba&) = default;
};

/// The picture of one depth plane, cropped to what is not empty. Its upper left pixel is pixel (left, top) of the
/// central view; slices reach beyond the view's sides by what the rig's outermost views look past them.
struct Slice {
  float parallax_px = 0;  ///< of the plane, at full eye separation; positive behind the screen
  int left = 0, top = 0;
  Image<LinearRgba> pixels;
};

/// What slices do to those behind them; sharply: a pixel hides all or nothing.
enum class SliceHiding { nothing, sharply, softly };

/// A scene cut into depth planes: enough to make every view of every rig (Hassaine 2010, sec. 6.2).
struct SliceStack {
  int width = 0, height = 0;         ///< of a view, in pixels
  float span = 1;                    ///< eye separations between the outermost views for which nothing is missing
  ToneSettings tone{.exposure = 1};  ///< how sums of the slices become colours
  ViewingGeometry viewing;           ///< for which the parallaxes were chosen
  std::vector<Slice> slices;         ///< nearest first: parallax ascends
  /// Of all slices together, where it was found before: looking at every pixel takes a third of drawing two views.
  std::optional<SliceHiding> hiding = {};
};

SliceHiding hiding_of(const SliceStack& stack);

/// How depth planes are filled with splats, and read between their pixels.
enum class SliceFilter {
  nearest,   ///< a splat goes to its nearest plane, and planes move by whole pixels
  linear,    ///< planes are interpolated between two pixels
  centroid,  ///< a splat between planes goes to both, by its distance, so that its middle is right in every view;
             ///< planes are interpolated by a cubic
};

}  // namespace wheatstone
