#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wheatstone/depth/rig.h"
#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// The lenses or slits before a screen's sub-pixels, as the screen's maker gives them.
struct LensSheet {
  int screen_width_px = 0, screen_height_px = 0;  ///< of the whole screen; 0: the display has no such sheet
  double period_subpixels = 0;                    ///< along a row, from one lens to the next
  double rows_a_subpixel = 0;                     ///< rows in which the lens leans by one sub-pixel; 0: it is upright
};

/// A display as one is sold. What differs between two of a kind (a lens sheet's exact pitch) is in the display's own
/// calibration file (display/lenticular.h).
struct DisplayPreset {
  std::string_view name;
  int views;
  int view_width_px, view_height_px;  ///< of each view
  int quilt_columns, quilt_rows;      ///< 0: the display takes no quilts
  int quilt_width_px, quilt_height_px;
  float aspect;  ///< width over height of the screen, as quilts are named
  float screen_width_mm;
  float viewing_distance_mm;  ///< typical
  float view_cone_deg;        ///< between the outermost views; 0: two views, one for each eye
  std::string_view note;      ///< what it is, in words for people
  LensSheet lenses = {};      ///< a display that takes one picture with all views interleaved under its lenses
};

/// All that have a name.
std::span<const DisplayPreset> display_presets();

/// Throws Error{wrong_usage} listing the names.
const DisplayPreset& find_display(std::string_view name);

/// An average viewer at the typical distance.
ViewingGeometry viewing_of(const DisplayPreset& display);

/// How far apart the outermost views are where the viewer is, in eye separations: the cone's width there.
float span_of(const DisplayPreset& display, float eye_separation_mm = 65);

}  // namespace wheatstone
