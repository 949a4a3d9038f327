#pragma once

#include <string>

#include "wheatstone/app/paint_photograph.h"

namespace wheatstone {

/// The measures of a painted photograph.
struct PaintingMeasures {
  PairMeasures painting;
  PairMeasures photographs;
  StrokeMeasures strokes;
};

/// `left_disparity` is the truth, or what is taken for it; NaN where unknown.
PaintingMeasures measure_painting(const StereoPair& photographs, const PaintedPhotograph& result,
                                  ImageView<const float> left_disparity);

/// The measures of one pair as a JSON object, in the words of the command line.
std::string pair_measures_json(const PairMeasures& measures);

/// What was done and how it came out, as a JSON document; `measures` may be null.
std::string report_json(const PaintedPhotograph& result, const Style& style, const PaintingMeasures* measures);

}  // namespace wheatstone
