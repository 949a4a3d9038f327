#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/app/display_views.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/match_confidence.h"
#include "wheatstone/measures/consistency.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/strokes/stroke_measures.h"

namespace wheatstone {

/// Which disparity lies on the screen plane.
struct ZeroParallax {
  std::optional<float> disparity_px;      ///< this one
  std::optional<std::pair<int, int>> at;  ///< that of this pixel (x, y) of the left photograph
                                          ///< neither: that of the nearest point, without outliers
};

struct PaintPhotographOptions {
  Style style;
  MatchOptions matching;
  std::optional<Image<float>> left_disparity;   ///< ready-made; none: the photographs are matched
  std::optional<Image<float>> right_disparity;  ///< only together with the left one
  std::vector<View> known;                      ///< as plan_painting's, with both disparities
  std::optional<Image<std::uint8_t>> detail;    ///< as plan_painting's; none: detail_of_faces
  ZeroParallax zero_parallax;
  Device device = Device::processor;                               ///< what draws the pictures
  std::optional<float> depth_budget = comfortable_parallax_share;  ///< of what is looked at, as PaintDrawing
};

/// A stereo photograph painted, and what it was painted from.
struct PaintedPhotograph {
  StereoGeometry geometry;
  std::optional<MatchedPair> matched;         ///< without its geometry, which is above; none where disparity was given
  std::optional<MatchConfidence> confidence;  ///< of what was matched
  PaintedPair painted;
  float zero_parallax_px = 0;
};

/// Photographs to painting in one call: match, or take the disparity that is given; paint; choose the screen plane.
/// One picture without depth, which is the left one while the right one is empty, is painted flat, at disparity 0: so
/// is the picture that is made of it. Throws Error: bad_input where pictures or disparity do not fit together,
/// wrong_usage for options that do not.
PaintedPhotograph paint_photograph(const StereoPair& photographs, const PaintPhotographOptions& options,
                                   const Progress& progress = {});

/// Places the painting's depth, draws it again for both eyes, over its canvas colour, and has disparity 0 on the
/// screen; nothing where there are no regions. Throws as place_depth (marks/mapped_depth.h) does.
void redraw_with_depth(const DepthPlacing& placing, PaintedPhotograph& result);

/// The disparities to paint from, and how they were found.
struct FoundGeometry {
  StereoGeometry geometry;
  std::optional<MatchedPair> matched;         ///< without its geometry; none where disparity was given
  std::optional<MatchConfidence> confidence;  ///< of what was matched
};

/// Matches the photographs, or takes the disparity that is given. Throws as paint_photograph does.
FoundGeometry find_geometry(const StereoPair& photographs, const PaintPhotographOptions& options,
                            const Progress& progress = {});

/// The disparity that is to lie on the screen. Throws Error{wrong_usage} for a point outside the picture.
float screen_disparity(const ZeroParallax& wanted, const StereoGeometry& geometry);

/// A photograph painted for a display, and how sure its matching is.
struct PaintedViews {
  DisplayViews views;
  std::optional<MatchConfidence> confidence;  ///< of what was matched; none where disparity was given
};

/// One stereo photograph, painted once, for every view of a display: what draw_display_views makes of its painting. The
/// screen plane is `painting.zero_parallax` where that is given, else that of `views`. Throws as paint_photograph and
/// draw_display_views do.
PaintedViews paint_views(const StereoPair& photographs, const PaintPhotographOptions& painting,
                         DisplayViewsOptions views, const Progress& progress = {},
                         const std::optional<DisplayComposition>& composition = {});

/// How consistent one pair of pictures is, by the measures that need no strokes.
struct PairMeasures {
  LeftRightDifference difference;
  DepthSurvival survival;
  double left_gradient_energy = 0;
  double right_gradient_energy = 0;
};

/// `left_disparity` is the truth, or what is taken for it; NaN where unknown. Throws Error{bad_input} where it is
/// unknown everywhere, or sizes differ.
PairMeasures measure_pair(const StereoPair& pair, ImageView<const float> left_disparity);

}  // namespace wheatstone
