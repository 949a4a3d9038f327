#pragma once

#include <array>
#include <string_view>

#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/study/path_graph.h"

namespace wheatstone {

/// A screen in front of somebody.
struct StudyScreen {
  float width_mm = 376;
  int width_px = 1024;
  int height_px = 768;
  float viewing_distance_mm = 700;
  float eye_separation_mm = 65;

  float pixel_pitch_mm() const { return width_mm / static_cast<float>(width_px); }
  /// The same for the functions of depth/viewing_geometry.h.
  ViewingGeometry viewing() const;
  friend bool operator==(const StudyScreen&, const StudyScreen&) = default;
};

/// The place of one eye, in mm: `x` to the right of the middle of the screen, at its height, `distance` before it.
struct EyePlace {
  float x_mm = 0;
  float distance_mm = 700;
  friend bool operator==(const EyePlace&, const EyePlace&) = default;
};

/// The place of a head, between its eyes.
using HeadPlace = EyePlace;

/// What is brought to the nearest view.
enum class Quantised {
  head,  ///< the head: each step shows a pair of views that is an eye separation apart, so that depth is as stated
  eyes,  ///< each eye on its own, as under the lenses of a display: depth changes where views lie wide apart
};

/// A multi-view display that a tracked stereoscopic screen plays (Hassaine 2010, 3.2.1).
struct SimulatedDisplay {
  float views_per_10cm = 0;  ///< along the head's movement; 0: one fixed pair of views
  Quantised quantised = Quantised::head;
  bool monoscopic = false;      ///< both eyes see the left one's view
  bool tracks_distance = true;  ///< else the views are made for the viewing distance
  float crosstalk = 0;          ///< share of an eye's light that comes from the two views beside its own
  friend bool operator==(const SimulatedDisplay&, const SimulatedDisplay&) = default;
};

/// What an eye is shown: a view, and half the crosstalk each of the views beside it.
struct SimulatedView {
  EyePlace view;
  std::array<EyePlace, 2> beside;
};

/// Left and right.
std::array<SimulatedView, 2> shown_views(const SimulatedDisplay& display, const StudyScreen& screen,
                                         const HeadPlace& head);

/// Where a view shows a place, in pixels of the screen: the line from the eye through the place meets the screen there.
/// A view that is made for where its eye is holds the perceived depth, whatever the head's place (the aim of Jones et
/// al. 2001, which 3.2.1 cites): stimuli are given in mm of the viewer's own space.
std::array<float, 2> on_screen_px(const StudyScreen& screen, const EyePlace& eye, const PlaceMm& place);

/// The place that two eyes perceive where each is shown its pixel: where their lines of sight come closest. False
/// rotation and flipping are what differs from the place that was drawn.
PlaceMm perceived_place(const StudyScreen& screen, const std::array<EyePlace, 2>& eyes,
                        const std::array<std::array<float, 2>, 2>& shown_px);

}  // namespace wheatstone
