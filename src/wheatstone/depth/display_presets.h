#pragma once

#include <span>
#include <string>
#include <string_view>

#include "wheatstone/depth/rig.h"
#include "wheatstone/depth/viewing_geometry.h"

namespace wheatstone {

/// A display as one is sold. What differs from one to the next of a kind (a lens sheet's exact pitch) is not here.
struct DisplayPreset {
  std::string_view name;
  int views;
  int view_width_px, view_height_px;  ///< of each view
  int quilt_columns, quilt_rows;      ///< 0 where it takes no quilts
  int quilt_width_px, quilt_height_px;
  float aspect;  ///< width over height of the screen, as quilts are named
  float screen_width_mm;
  float viewing_distance_mm;  ///< typical
  float view_cone_deg;        ///< between the outermost views; 0: two views, one for each eye
  std::string_view note;      ///< what it is, in words for people
};

/// All that have a name.
std::span<const DisplayPreset> display_presets();

/// Throws Error{wrong_usage} listing the names.
const DisplayPreset& find_display(std::string_view name);

/// An average viewer at the typical distance.
ViewingGeometry viewing_of(const DisplayPreset& display);

/// How far apart the outermost views are where the viewer is, in eye separations: the cone's width there.
float span_of(const DisplayPreset& display, float eye_separation_mm = 65);

/// The display's views.
Rig rig_of(const DisplayPreset& display, float eye_separation_mm = 65);

}  // namespace wheatstone
