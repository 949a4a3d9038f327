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
    : width_(width),
      samples_(samples),
      stride_((static_cast<std::size_t>(width) + block - 1) / block * block),
      columns_(sample_columns(samples)) {}

void TriangleBand::begin(int first_row, int end_row) {
  first_row_ = first_row;
  end_row_ = end_row;
  const auto lines = static_cast<std::size_t>(end_row - first_row) * static_cast<std::size_t>(samples_);
  lines_.resize(std::max(lines, lines_.size()));
  for (CrossedLine& line : lines_) {
    line.edges.clear();
    line.between.clear();
  }
  nearest_.resize(lines * stride_);
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
      CrossedLine& line = lines_[static_cast<std::size_t>(number - begin)];
      line.edges.push_back({long_edge.x(y), long_edge.disparity(y), short_edge.x(y), short_edge.disparity(y)});
      line.between.push_back({long_edge.nearness(y), short_edge.nearness(y), index});
    }
  }
}

}  // namespace wheatstone
