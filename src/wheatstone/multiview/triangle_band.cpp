#include "wheatstone/multiview/triangle_band_internal.h"

#include <algorithm>
#include <array>
#include <limits>

namespace wheatstone {
namespace {

/// The least integer that is not below a number of moderate size.
int ceiling(double number) {
  const int whole = static_cast<int>(number);
  return whole + (number > whole ? 1 : 0);
}
int ceiling(float number) {
  const int whole = static_cast<int>(number);
  return whole + (number > static_cast<float>(whole) ? 1 : 0);
}

/// Along an edge, place, disparity and nearness are linear in y.
class TriangleEdge {
 public:
  TriangleEdge(const ScreenTriangle& triangle, const std::array<double, 3>& nearness, std::size_t from, std::size_t to)
      : x_(static_cast<double>(triangle.x[from])),
        y_(static_cast<double>(triangle.y[from])),
        disparity_(static_cast<double>(triangle.disparity[from])),
        nearness_(nearness[from]) {
    const double per_row = 1 / (static_cast<double>(triangle.y[to]) - y_);
    x_by_y_ = (static_cast<double>(triangle.x[to]) - x_) * per_row;
    disparity_by_y_ = (static_cast<double>(triangle.disparity[to]) - disparity_) * per_row;
    nearness_by_y_ = (nearness[to] - nearness_) * per_row;
  }
  float x(double y) const { return static_cast<float>(x_ + (y - y_) * x_by_y_); }
  float disparity(double y) const { return static_cast<float>(disparity_ + (y - y_) * disparity_by_y_); }
  float nearness(double y) const { return static_cast<float>(nearness_ + (y - y_) * nearness_by_y_); }

 private:
  double x_, y_, disparity_, nearness_, x_by_y_, disparity_by_y_, nearness_by_y_;
};

}  // namespace

std::span<const float> sample_columns(int count) {
  static constexpr std::array<float, 4> of_four{6.f / 16, 14.f / 16, 2.f / 16, 10.f / 16};
  static constexpr std::array<float, 8> of_eight{15.f / 16, 3.f / 16,  5.f / 16, 9.f / 16,
                                                 7.f / 16,  13.f / 16, 1.f / 16, 11.f / 16};
  if (count == 8) return of_eight;
  return of_four;
}

TriangleBand::TriangleBand(int width, int samples)
    : width_(width), samples_(samples), columns_(sample_columns(samples)) {}

void TriangleBand::Line::clear() {
  x0.clear();
  disparity0.clear();
  x1.clear();
  disparity1.clear();
  filling.clear();
}

void TriangleBand::begin(int first_row, int end_row) {
  first_row_ = first_row;
  end_row_ = end_row;
  const auto lines = static_cast<std::size_t>(end_row - first_row) * static_cast<std::size_t>(samples_);
  lines_.resize(std::max(lines, lines_.size()));
  for (Line& line : lines_) line.clear();
  nearest_.resize(lines * static_cast<std::size_t>(width_));
  shown_.resize(nearest_.size());
}

void TriangleBand::add(const ScreenTriangle& triangle, std::uint32_t index, bool is_orthographic) {
  const double samples = samples_;
  std::array<double, 3> nearness{};
  std::array<int, 3> first_line{};  // at a corner or below it
  for (std::size_t k = 0; k < 3; ++k) {
    nearness[k] = triangle.nearness(k, is_orthographic);
    first_line[k] = ceiling(static_cast<double>(triangle.y[k]) * samples - 0.5);
  }
  const TriangleEdge long_edge(triangle, nearness, 0, 2);
  const int begin = first_row_ * samples_, end = end_row_ * samples_;
  for (std::size_t upper = 0; upper < 2; ++upper) {
    const int from = std::max(first_line[upper], begin), to = std::min(first_line[upper + 1], end);
    if (from >= to) continue;
    const TriangleEdge short_edge(triangle, nearness, upper, upper + 1);
    for (int number = from; number < to; ++number) {
      const double y = (number + 0.5) / samples;
      Line& line = lines_[static_cast<std::size_t>(number - begin)];
      line.x0.push_back(long_edge.x(y));
      line.disparity0.push_back(long_edge.disparity(y));
      line.x1.push_back(short_edge.x(y));
      line.disparity1.push_back(short_edge.disparity(y));
      line.filling.push_back({long_edge.nearness(y), short_edge.nearness(y), index});
    }
  }
}

void TriangleBand::show_line(const Line& line, float column, float view, std::span<float> nearest,
                             std::span<std::uint32_t> shown) {
  constexpr std::size_t at_once = 256;
  std::array<int, at_once> at0, at1, crossed;
  const std::size_t count = line.filling.size();
  for (std::size_t first = 0; first < count; first += at_once) {
    const std::size_t some = std::min(at_once, count - first);
    // Most triangles that are smaller than the distance of samples lie between two of them.
    const float *x0 = line.x0.data() + first, *x1 = line.x1.data() + first;
    const float *disparity0 = line.disparity0.data() + first, *disparity1 = line.disparity1.data() + first;
    for (std::size_t i = 0; i < some; ++i) {
      at0[i] = ceiling(x0[i] - view * disparity0[i] - column);
      at1[i] = ceiling(x1[i] - view * disparity1[i] - column);
    }
    std::size_t crossings = 0;
    for (std::size_t i = 0; i < some; ++i) {
      crossed[crossings] = static_cast<int>(i);
      crossings += at0[i] != at1[i] ? 1 : 0;
    }
    for (std::size_t n = 0; n < crossings; ++n) {
      const auto i = static_cast<std::size_t>(crossed[n]);
      float left = x0[i] - view * disparity0[i], right = x1[i] - view * disparity1[i];
      const Line::Filling& filling = line.filling[first + i];
      float near_left = filling.nearness0, near_right = filling.nearness1;
      const int begin = std::max(std::min(at0[i], at1[i]), 0), end = std::min(std::max(at0[i], at1[i]), width_);
      if (right < left) {
        std::swap(left, right);
        std::swap(near_left, near_right);
      }
      // In a narrower part, the slope would be lost in rounding errors.
      constexpr float narrow_px = 1.f / 64;
      const bool is_narrow = right - left < narrow_px;
      const float by_x = is_narrow ? 0 : (near_right - near_left) / (right - left);
      const float start = is_narrow ? (near_left + near_right) / 2 : near_left + (column - left) * by_x;
      for (int c = begin; c < end; ++c) {
        const float near = start + static_cast<float>(c) * by_x;
        const auto at = static_cast<std::size_t>(c);
        const bool is_nearest = near > nearest[at];
        nearest[at] = is_nearest ? near : nearest[at];
        shown[at] = is_nearest ? filling.triangle : shown[at];
      }
    }
  }
}

void TriangleBand::show(float view) {
  std::ranges::fill(nearest_, -std::numeric_limits<float>::infinity());
  std::ranges::fill(shown_, nothing);
  const auto width = static_cast<std::size_t>(width_);
  for (std::size_t line = 0; line * width < nearest_.size(); ++line)
    show_line(lines_[line], columns_[line % static_cast<std::size_t>(samples_)], view,
              std::span(nearest_).subspan(line * width, width), std::span(shown_).subspan(line * width, width));
}

}  // namespace wheatstone
