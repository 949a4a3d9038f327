#pragma once

#include <string>

#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/measures/wrong_spots.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {

/// The measures of a painted photograph.
struct PaintingMeasures {
  PairMeasures painting;
  PairMeasures photographs;
  StrokeMeasures strokes;
  WrongSpots wrong_spots;
};

/// `left_disparity` is the truth, or what is taken for it; NaN where unknown.
PaintingMeasures measure_painting(const StereoPair& photographs, const PaintedPhotograph& result,
                                  ImageView<const float> left_disparity, const Progress& progress = {});

/// Wrong spots as a JSON object.
std::string wrong_spots_json(const WrongSpots& spots);

/// The measures of one pair as a JSON object, in the words of the command line.
std::string pair_measures_json(const PairMeasures& measures);

/// How both pictures are rectified as a JSON object: of `left` and `right` the members of RectifyingMap but the size.
std::string rectification_json(const Rectification& how);

/// How a pair was prepared as a JSON object: `rectified`, `compared_features`, `row_difference` (median and 95th
/// percentile), `photographs_row_difference` (before rectification), `rectification`, `eyes_look_swapped` (null where
/// the pictures do not tell) and `warning`; null where there is nothing to tell.
std::string preparation_json(const PreparedPair& pair);

/// How sure a match is as a JSON object: the members of MatchConfidence, and `warning`, null where there is none.
std::string confidence_json(const MatchConfidence& confidence);

/// The contents of a report; borrowed.
struct PaintingReport {
  const PaintedPhotograph& painted;
  const Style& style;
  const PreparedPair* pair = nullptr;          ///< that was painted; none: nothing is told of it
  const PaintingMeasures* measures = nullptr;  ///< none: not measured
  PictureSize whole{};  ///< of the photographs, where a reduced copy was painted; 0: they were painted as they are
};

/// The report as a JSON document.
std::string report_json(const PaintingReport& told);

}  // namespace wheatstone
