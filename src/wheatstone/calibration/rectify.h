#pragma once

#include <array>
#include <optional>

#include "wheatstone/calibration/calibration.h"
#include "wheatstone/calibration/colour_transfer.h"
#include "wheatstone/calibration/rectifying_map.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

struct RectifyOptions {
  bool match_colour = true;  ///< bring the right picture's exposure and colour to the left one's
  bool keep_size = false;    ///< enlarge what is common to both, as far as it has their shape, to the photographs' size
  /// A flat scene, or one that was seen from one place, is an error; without it, the least turn that fits is taken.
  bool cameras_must_be_decided = true;
};

/// |y_left − y_right| of matched features, in pixels.
struct VerticalDisparity {
  double median_px = 0;
  double percentile_95_px = 0;
};

/// How both pictures of a pair are rectified and cropped; fits every pair that the same cameras took in the same
/// places.
struct Rectification {
  RectifyingMap left, right;
  int width = 0;  ///< of the rectified pictures
  int height = 0;
};

/// Two pictures whose corresponding points share a row, cropped to the largest rectangle that is filled in both: both
/// have the same size and the same rows and columns of the turned cameras' pictures.
struct RectifiedPair {
  StereoPair pictures;
  std::optional<Rectification> rectification;  ///< none where a calibration says it
  int measured_matches = 0;              ///< feature matches that the measures below are made of; none of them decided
                                         ///< the rectification. 0: too few to measure
  VerticalDisparity before, after;       ///< of those matches, in the photographs and in the rectified pictures
  double shift_px = 0;                   ///< added to all disparities so that none of the matches' is below 0
  bool eyes_swapped = false;             ///< by the calibration, the left picture is that of the camera on the right
  std::optional<ColourTransfer> colour;  ///< applied to the right picture; none where not asked for or not decided
};

/// Rectifies a pair from what its pictures have in common, by turning both as little as possible. The middle of each
/// picture stays in its column, so that disparities stay about what they were; where the farthest matches would then
/// have a disparity (x_left − x_right) below 0, the right picture is shifted just enough (`shift_px`). A radial
/// distortion that both lenses share, and a smooth field of row differences, are taken out where matches that did not
/// decide them say that this helps. Throws Error{bad_input}: sizes differ; too few features; the pictures do not show
/// one scene; the scene is flat or was seen from one place, so that the cameras' positions are not decided; the camera
/// moved forwards.
RectifiedPair rectify(const StereoPair& photographs, const RectifyOptions& options = {}, const Progress& progress = {});

/// Rectifies a pair of a calibrated rig, lenses undistorted; what is infinitely far has disparity 0. Features serve to
/// measure and to match colours only. Throws Error{bad_input} where the pictures have not the calibration's size, where
/// nothing is visible to both cameras, or where rows still differ so much that the calibration is of another rig.
RectifiedPair rectify(const StereoPair& photographs, const StereoCalibration& calibration,
                      const RectifyOptions& options = {}, const Progress& progress = {});

/// How much of its photograph's area a rectified picture shows, 0..1; of the eye that loses more.
double kept_area(const Rectification& rectification);

/// Another pair of the same cameras, geometry only.
StereoPair rectified(const StereoPair& photographs, const Rectification& how);
/// The left picture of such a pair, with 16 bits a channel.
Image<Rgb16> rectified_left(ImageView<const Rgb16> photograph, const Rectification& how);

}  // namespace wheatstone
