#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/strokes/fit_stroke_internal.h"

namespace wheatstone {
namespace {

constexpr int steps_of_level = 10;  ///< luminance is summed in whole steps, so that no order matters

/// Rec. 601.
std::int32_t luminance_in_steps(int red, int green, int blue) {
  return (299 * red + 587 * green + 114 * blue + 50) / (1000 / steps_of_level);
}

/// Sums of luminances, and of their squares, over the rows of a window, for columns from `left` on: those of an area
/// and a window's reach on both sides, of which some may lie outside the picture.
struct ColumnSums {
  ColumnSums(const PixelArea& area, int picture_width)
      : left(area.left - weight_reach_px),
        first(std::max(left, 0)),
        end(std::min(area.right + weight_reach_px, picture_width)),
        values(static_cast<std::size_t>(area.right + weight_reach_px - left)),
        squares(values) {}

  void change(const ReferencePicture& picture, int y, int sign) {
    if (y < 0 || y >= picture.red.height()) return;
    const auto part = [&](const Image<std::uint8_t>& plane) { return &plane(first, y); };
    const std::uint8_t *red = part(picture.red), *green = part(picture.green), *blue = part(picture.blue);
    std::int32_t* const value = values.data() + (first - left);
    std::int32_t* const square = squares.data() + (first - left);
    for (int x = 0; x < end - first; ++x) {
      const std::int32_t luminance = luminance_in_steps(red[x], green[x], blue[x]);
      value[x] += sign * luminance;
      square[x] += sign * luminance * luminance;
    }
  }

  int left, first, end;
  std::vector<std::int32_t> values, squares;
};

int in_window(int i, int count) {
  return std::min(i + weight_reach_px, count - 1) - std::max(i - weight_reach_px, 0) + 1;
}

void weigh_row(const ColumnSums& sums, std::span<const float> columns_in_window, int rows_in_window,
               std::span<float> weights) {
  constexpr int last = 2 * weight_reach_px;  // column of a window
  thread_local std::vector<std::int32_t> values, squares;
  values.resize(weights.size());
  squares.resize(weights.size());
  std::int32_t value = 0, square = 0;
  for (int i = 0; i < last; ++i) {
    value += sums.values[i];
    square += sums.squares[i];
  }
  for (std::size_t x = 0; x < weights.size(); ++x) {
    value += sums.values[x + last];
    square += sums.squares[x + last];
    values[x] = value;
    squares[x] = square;
    value -= sums.values[x];
    square -= sums.squares[x];
  }
  // A loop that compilers turn into vectors.
  constexpr float of_step = FitColour::luminance_step / steps_of_level, least_weight = 0.25f;
  const auto rows = static_cast<float>(rows_in_window);
  for (std::size_t x = 0; x < weights.size(); ++x) {
    const float share = 1 / (columns_in_window[x] * rows);
    const float mean = of_step * share * static_cast<float>(values[x]);
    const float variance = of_step * of_step * share * static_cast<float>(squares[x]) - mean * mean;
    const float contrast = std::sqrt(variance > 0 ? variance : 0) / (2.5f + 0.04f * mean);
    // Contrast that shows clearly counts half beyond there: the most detailed places are worked hardest.
    const float counted = std::min(std::min(contrast, 0.5f + 0.5f * contrast), 2.f);
    weights[x] = least_weight + (1 - least_weight) * counted;
  }
}

/// The factor on the weight of a difference, by View::detail: the more finely a place is to be painted, the larger.
/// White has the effect of a fineness that is 0.5 higher.
std::array<float, 256> factors_of_detail() {
  std::array<float, 256> all{};
  for (std::size_t i = 0; i < all.size(); ++i)
    all[i] = std::exp2(steps_of_fineness * ((static_cast<float>(i) - even_detail) / 255));
  return all;
}

/// Factor on the weight of pixels beside depth edges for fine strokes, because broad paint of one surface would show
/// there as a rim of the other.
constexpr float factor_of_outline = 2, fine_radius_px = 6;

void multiply(std::span<float> weights, std::span<const std::uint8_t> values, const std::array<float, 256>& factors) {
  for (std::size_t x = 0; x < weights.size(); ++x) weights[x] *= factors[values[x]];
}

}  // namespace

bool weighs_outlines(const LayerPlan& plan) { return !plan.depth_edges.empty() && plan.radius_px <= fine_radius_px; }

std::vector<float> difference_weights(const LayerPlan& plan, const PixelArea& area) {
  const ImageView<const std::uint8_t> detail = plan.view.detail;
  static const std::array<float, 256> of_detail = factors_of_detail();
  std::array<float, 256> of_outline{1};
  std::fill(of_outline.begin() + 1, of_outline.end(), factor_of_outline);
  const int width = plan.reference->red.width(), height = plan.reference->red.height();
  const auto columns = static_cast<std::size_t>(area.right - area.left);
  std::vector<float> columns_in_window(columns), weights(columns * static_cast<std::size_t>(area.bottom - area.top));
  for (std::size_t i = 0; i < columns; ++i)
    columns_in_window[i] = static_cast<float>(in_window(area.left + static_cast<int>(i), width));
  ColumnSums sums(area, width);
  for (int y = area.top - weight_reach_px; y < area.top + weight_reach_px; ++y) sums.change(*plan.reference, y, 1);
  const auto of_area = [&](std::span<const std::uint8_t> row) {
    return row.subspan(static_cast<std::size_t>(area.left), columns);
  };
  for (int y = area.top; y < area.bottom; ++y) {
    const auto row = std::span(weights).subspan(static_cast<std::size_t>(y - area.top) * columns, columns);
    sums.change(*plan.reference, y + weight_reach_px, 1);
    weigh_row(sums, columns_in_window, in_window(y, height), row);
    sums.change(*plan.reference, y - weight_reach_px, -1);
    if (!detail.empty()) multiply(row, of_area(detail.row(y)), of_detail);
    if (weighs_outlines(plan)) multiply(row, of_area(plan.depth_edges.row(y)), of_outline);
  }
  return weights;
}

}  // namespace wheatstone
