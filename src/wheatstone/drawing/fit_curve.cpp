#include <algorithm>
#include <cmath>

#include "wheatstone/drawing/fit_curve_internal.h"

namespace wheatstone {
namespace {

PlanePoint operator-(PlanePoint a, PlanePoint b) { return {a.x - b.x, a.y - b.y}; }
PlanePoint operator+(PlanePoint a, PlanePoint b) { return {a.x + b.x, a.y + b.y}; }
PlanePoint operator*(float factor, PlanePoint a) { return {factor * a.x, factor * a.y}; }
float dot(PlanePoint a, PlanePoint b) { return a.x * b.x + a.y * b.y; }
float length(PlanePoint a) { return std::hypot(a.x, a.y); }
PlanePoint unit(PlanePoint a) { return 1 / length(a) * a; }

PlanePoint at(const BezierCurve& curve, float t) {
  const float s = 1 - t;
  return s * s * s * curve.begin + 3 * s * s * t * curve.first + 3 * s * t * t * curve.second + t * t * t * curve.end;
}

/// The parameter near t at which the curve comes closest to a place: one step of Newton's method.
float closer(const BezierCurve& curve, PlanePoint place, float t) {
  const float s = 1 - t;
  const PlanePoint a = curve.first - curve.begin, b = curve.second - curve.first, c = curve.end - curve.second;
  const PlanePoint slope = 3 * s * s * a + 6 * s * t * b + 3 * t * t * c;
  const PlanePoint bend = 6 * s * (b - a) + 6 * t * (c - b);
  const PlanePoint off = at(curve, t) - place;
  const float change = dot(slope, slope) + dot(off, bend);
  return change > 0 ? std::clamp(t - dot(off, slope) / change, 0.f, 1.f) : t;
}

/// The curve with these ends and directions that comes closest to the places at their parameters.
BezierCurve closest_curve(std::span<const PlanePoint> chain, const std::vector<float>& parameters, PlanePoint ahead,
                          PlanePoint back) {
  const PlanePoint begin = chain.front(), end = chain.back();
  float aa = 0, ab = 0, bb = 0, right_a = 0, right_b = 0;
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const float t = parameters[i], s = 1 - t;
    const float near_begin = 3 * s * s * t, near_end = 3 * s * t * t;
    const PlanePoint rest = chain[i] - (s * s * s + near_begin) * begin - (t * t * t + near_end) * end;
    aa += near_begin * near_begin;
    ab += near_begin * near_end * dot(ahead, back);
    bb += near_end * near_end;
    right_a += near_begin * dot(ahead, rest);
    right_b += near_end * dot(back, rest);
  }
  const float determinant = aa * bb - ab * ab;
  const float third = length(end - begin) / 3;
  float reach_begin = third, reach_end = third;
  if (determinant > 1e-6f * aa * bb) {
    reach_begin = (right_a * bb - right_b * ab) / determinant;
    reach_end = (right_b * aa - right_a * ab) / determinant;
  }
  // Beyond these the curve would have loops that the chain has not.
  const float least = 0.01f * third, most = 10 * third;
  return {begin, begin + std::clamp(reach_begin, least, most) * ahead, end + std::clamp(reach_end, least, most) * back,
          end};
}

/// A chain's direction at one of its points.
PlanePoint direction(std::span<const PlanePoint> chain, std::size_t i) {
  const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, chain.size() - 1);
  const PlanePoint through = chain[after] - chain[before];
  return length(through) > 0 ? unit(through) : unit(chain[after] - chain[i]);
}

/// Fits one curve to the part [from, to] of a chain; false where it strays further than the tolerance.
bool fit_one(std::span<const PlanePoint> chain, std::size_t from, std::size_t to, float tolerance_px,
             BezierCurve& curve) {
  const auto part = chain.subspan(from, to - from + 1);
  const PlanePoint ahead = direction(chain, from), back = -1 * direction(chain, to);
  std::vector<float> parameters(part.size());
  for (std::size_t i = 1; i < part.size(); ++i) parameters[i] = parameters[i - 1] + length(part[i] - part[i - 1]);
  for (float& t : parameters) t /= parameters.back();
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    curve = closest_curve(part, parameters, ahead, back);
    float farthest = 0;
    for (std::size_t i = 0; i < part.size(); ++i) {
      parameters[i] = closer(curve, part[i], parameters[i]);
      farthest = std::max(farthest, length(at(curve, parameters[i]) - part[i]));
    }
    if (farthest <= tolerance_px) return true;
  }
  return false;
}

}  // namespace

std::vector<BezierCurve> fit_curves(std::span<const PlanePoint> chain, float tolerance_px) {
  std::vector<PlanePoint> places;
  for (const PlanePoint place : chain)
    if (places.empty() || length(place - places.back()) > 1e-3f) places.push_back(place);
  std::vector<BezierCurve> curves;
  for (std::size_t from = 0; from + 1 < places.size();) {
    std::size_t to = places.size() - 1;
    BezierCurve curve;
    while (to > from + 1 && !fit_one(places, from, to, tolerance_px, curve)) to = from + (to - from) / 2;
    if (to == from + 1) {
      const PlanePoint step = places[to] - places[from];
      curve = {places[from], places[from] + 1.f / 3 * step, places[from] + 2.f / 3 * step, places[to]};
    }
    curves.push_back(curve);
    from = to;
  }
  return curves;
}

}  // namespace wheatstone
