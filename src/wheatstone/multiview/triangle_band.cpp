#include "wheatstone/multiview/triangle_band_internal.h"

#include <algorithm>
#include <array>

namespace wheatstone {
namespace {

/// The least integer that is not below a number of moderate size.
int ceiling(double number) {
  const int whole = static_cast<int>(number);
  return whole + (number > whole ? 1 : 0);
}

}  // namespace

std::span<const double> sample_columns(int count) {
  static constexpr std::array<double, 4> of_four{6. / 16, 14. / 16, 2. / 16, 10. / 16};
  static constexpr std::array<double, 8> of_eight{15. / 16, 3. / 16,  5. / 16, 9. / 16,
                                                  7. / 16,  13. / 16, 1. / 16, 11. / 16};
  if (count == 8) return of_eight;
  return of_four;
}

TriangleBand::TriangleBand(int width, int samples)
    : width_(width), samples_(samples), columns_(sample_columns(samples)) {}

void TriangleBand::begin(int first_row, int end_row) {
  first_row_ = first_row;
  end_row_ = end_row;
  const auto count = static_cast<std::size_t>(width_) * static_cast<std::size_t>((end_row - first_row) * samples_);
  nearness_.assign(count, -std::numeric_limits<float>::infinity());
  shown_.assign(count, nothing);
}

void TriangleBand::draw(const ScreenTriangle& triangle, std::uint32_t index, double view, bool is_orthographic) {
  const double samples = samples_;
  std::array<double, 3> x{}, y{}, nearness{};
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = static_cast<double>(triangle.x[k]) - view * static_cast<double>(triangle.disparity[k]);
    y[k] = static_cast<double>(triangle.y[k]);
    nearness[k] = triangle.nearness(k, is_orthographic);
  }
  // Along the long edge and along one of the two short ones, place and nearness are linear in y.
  struct Edge {
    double x, y, by_y, nearness, nearness_by_y;
    Edge(std::size_t from, std::size_t to, const std::array<double, 3>& xs, const std::array<double, 3>& ys,
         const std::array<double, 3>& near)
        : x(xs[from]), y(ys[from]), nearness(near[from]) {
      const double per_row = 1 / (ys[to] - ys[from]);
      by_y = (xs[to] - xs[from]) * per_row;
      nearness_by_y = (near[to] - near[from]) * per_row;
    }
  };
  const Edge long_edge(0, 2, x, y, nearness);
  const int last = end_row_ * samples_;
  int line = std::max(ceiling(y[0] * samples - 0.5), first_row_ * samples_);
  for (std::size_t upper = 0; upper < 2; ++upper) {
    const int end = std::min(ceiling(y[upper + 1] * samples - 0.5), last);
    if (line >= end) continue;
    const Edge short_edge(upper, upper + 1, x, y, nearness);
    for (; line < end; ++line) {
      const double at = (line + 0.5) / samples;
      double left = long_edge.x + (at - long_edge.y) * long_edge.by_y;
      double right = short_edge.x + (at - short_edge.y) * short_edge.by_y;
      const double column = columns_[static_cast<std::size_t>(line % samples_)];
      int first = ceiling(left - column), past = ceiling(right - column);
      if (first == past) continue;
      double near_left = long_edge.nearness + (at - long_edge.y) * long_edge.nearness_by_y;
      double near_right = short_edge.nearness + (at - short_edge.y) * short_edge.nearness_by_y;
      if (first > past) {
        std::swap(first, past);
        std::swap(left, right);
        std::swap(near_left, near_right);
      }
      first = std::max(first, 0);
      past = std::min(past, width_);
      if (first >= past) continue;
      const double by_x = (near_right - near_left) / (right - left);
      double near = near_left + (first + column - left) * by_x;
      const std::size_t begin =
          static_cast<std::size_t>(line - first_row_ * samples_) * static_cast<std::size_t>(width_);
      float* const nearest = nearness_.data() + begin;
      std::uint32_t* const shown = shown_.data() + begin;
      for (int c = first; c < past; ++c, near += by_x) {
        const auto here = static_cast<float>(near);
        if (here > nearest[c]) {
          nearest[c] = here;
          shown[c] = index;
        }
      }
    }
  }
}

}  // namespace wheatstone
