#pragma once

#include <span>

namespace wheatstone {

/// A point of a curve that is a cubic between each two neighbours.
struct CurvePoint {
  double at = 0;
  double value = 0;
  double slope = 0;
};

/// Gives the points, whose places ascend or descend, the slopes at which no cubic between neighbours turns: the
/// harmonic mean of the two sides' slopes, weighted by their lengths, never steeper than three times either (Fritsch &
/// Carlson 1980; Fritsch & Butland 1984). At the ends it is that of the straight line to the neighbour.
void choose_slopes(std::span<CurvePoint> points);

/// The cubic of two neighbours, at a share of the way from one to the other.
double value_between(const CurvePoint& from, const CurvePoint& to, double share);

/// The curve at a place, where those of the points ascend; beyond its ends the value stays what it is there.
double value_at(std::span<const CurvePoint> points, double at);

}  // namespace wheatstone
