#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

#include "wheatstone/models/model.h"

namespace wheatstone {
namespace {

using Vector = std::array<double, 3>;

Vector difference(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector unit(const Vector& v) {
  const double length = std::sqrt(dot(v, v));
  return length > 0 ? Vector{v[0] / length, v[1] / length, v[2] / length} : Vector{0, 0, 1};
}

struct PositionHash {
  std::size_t operator()(const Vector& position) const {
    std::uint64_t hash = 0x9e3779b97f4a7c15u;
    for (const double coordinate : position) {
      std::uint64_t bits = 0;
      const double plain = coordinate + 0.0;  // -0 is 0
      std::memcpy(&bits, &plain, sizeof(bits));
      hash = (hash ^ bits) * 0xff51afd7ed558ccdu;
      hash ^= hash >> 32;
    }
    return hash;
  }
};

/// The number of each vertex's position among the different ones.
std::vector<std::uint32_t> numbered_positions(const std::vector<Vector>& positions, std::size_t& count) {
  std::unordered_map<Vector, std::uint32_t, PositionHash> known(positions.size());
  std::vector<std::uint32_t> numbers;
  numbers.reserve(positions.size());
  for (const Vector& position : positions)
    numbers.push_back(known.try_emplace(position, static_cast<std::uint32_t>(known.size())).first->second);
  count = known.size();
  return numbers;
}

/// A corner of a triangle: three a triangle, in order.
struct Corner {
  std::uint32_t triangle;
  double angle;
};

/// The corners at each position, those of position p from begin[p] to begin[p + 1].
struct CornersByPosition {
  std::vector<std::uint32_t> begin;
  std::vector<Corner> corners;
};

double angle_between(const Vector& a, const Vector& b) { return std::acos(std::clamp(dot(unit(a), unit(b)), -1., 1.)); }

CornersByPosition corners_by_position(const Model& model, std::span<const std::uint32_t> number, std::size_t count) {
  CornersByPosition by;
  by.begin.assign(count + 1, 0);
  for (const auto& triangle : model.triangles)
    for (const std::uint32_t vertex : triangle) ++by.begin[number[vertex] + 1];
  std::partial_sum(by.begin.begin(), by.begin.end(), by.begin.begin());
  by.corners.resize(by.begin.back());
  std::vector<std::uint32_t> next(by.begin.begin(), by.begin.end() - 1);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    const auto& triangle = model.triangles[t];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector& here = model.positions[triangle[k]];
      const Vector to_next = difference(model.positions[triangle[(k + 1) % 3]], here);
      const Vector to_last = difference(model.positions[triangle[(k + 2) % 3]], here);
      by.corners[next[number[triangle[k]]]++] = {static_cast<std::uint32_t>(t), angle_between(to_next, to_last)};
    }
  }
  return by;
}

/// Appends a vertex that differs from another in its normal.
std::uint32_t double_vertex(Model& model, std::uint32_t vertex, const std::array<float, 3>& normal) {
  const auto copy = [vertex](auto& column) {
    if (column.empty()) return;
    const auto value = column[vertex];
    column.push_back(value);
  };
  copy(model.positions);
  copy(model.texture_places);
  copy(model.colours);
  model.normals.push_back(normal);
  return static_cast<std::uint32_t>(model.positions.size() - 1);
}

}  // namespace

void make_normals(Model& model, float crease_deg) {
  std::size_t count = 0;
  const std::vector<std::uint32_t> number = numbered_positions(model.positions, count);
  const CornersByPosition by = corners_by_position(model, number, count);
  std::vector<Vector> of_triangle;
  of_triangle.reserve(model.triangles.size());
  for (const auto& [a, b, c] : model.triangles)
    of_triangle.push_back(unit(
        cross(difference(model.positions[b], model.positions[a]), difference(model.positions[c], model.positions[a]))));
  // A little more than the angle: that of a regular shape is computed with rounding.
  const double least_cosine = std::cos(crease_deg * std::numbers::pi / 180) - 1e-6;

  constexpr std::uint32_t none = ~std::uint32_t{0};
  const std::size_t vertices = model.positions.size();
  model.normals.assign(vertices, {});
  std::vector<std::uint32_t> more(vertices, none);  // the next vertex that differs from one only in its normal
  std::vector<bool> has_normal(vertices);
  for (std::size_t t = 0; t < model.triangles.size(); ++t) {
    for (std::uint32_t& vertex : model.triangles[t]) {
      Vector sum{};
      const std::uint32_t position = number[vertex];
      for (std::uint32_t i = by.begin[position]; i < by.begin[position + 1]; ++i) {
        const Vector& other = of_triangle[by.corners[i].triangle];
        if (dot(other, of_triangle[t]) < least_cosine) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] += by.corners[i].angle * other[axis];
      }
      const Vector mean = dot(sum, sum) > 0 ? unit(sum) : of_triangle[t];
      const std::array<float, 3> normal{static_cast<float>(mean[0]), static_cast<float>(mean[1]),
                                        static_cast<float>(mean[2])};
      if (!has_normal[vertex]) {
        has_normal[vertex] = true;
        model.normals[vertex] = normal;
        continue;
      }
      std::uint32_t same = vertex;
      while (model.normals[same] != normal && more[same] != none) same = more[same];
      if (model.normals[same] != normal) {
        more[same] = double_vertex(model, vertex, normal);
        same = more[same];
        more.push_back(none);
      }
      vertex = same;
    }
  }
}

}  // namespace wheatstone
