#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "wheatstone/marks/stroke_painting.h"

namespace wheatstone {

/// New numbers for the strokes of one of a scene's views; those of the other views lie between them, so that all views
/// are planned at once. Fitted strokes that begin a scene are numbered by place: however a still is planned again, a
/// stroke that does not change keeps its bristles. Later frames would use up the numbers.
class StrokeNumbers {
 public:
  StrokeNumbers(std::uint32_t last, std::size_t view, std::size_t views, bool by_place)
      : by_place_(by_place),
        next_(last + 1 + static_cast<std::uint32_t>(view)),
        step_(static_cast<std::uint32_t>(by_place ? std::max(views, views_of_still) : views)) {}

  /// The strokes' numbers are those of their places, from 1 to `places`.
  void give(std::uint32_t places, Layer& layer) {
    for (std::uint32_t i = 0; Stroke & stroke : layer.strokes)
      stroke.number = next_ + step_ * (by_place_ ? stroke.number - 1 : i++);
    next_ += step_ * (by_place_ ? places : static_cast<std::uint32_t>(layer.strokes.size()));
  }

 private:
  static constexpr std::size_t views_of_still = 8;  ///< at least as many as a scene of two photographs has

  bool by_place_;
  std::uint32_t next_, step_;
};

}  // namespace wheatstone
