#include "wheatstone/image/reduced_view.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace wheatstone {
namespace {

constexpr float one_surface_px = 1;

/// Some neighbouring rows, by columns: sums of the colours, whether any pixel is wanted, and the range of disparities.
struct RowSums {
  explicit RowSums(std::size_t width)
      : colours(3 * width),
        seeds(width),
        farthest(width, std::numeric_limits<float>::infinity()),
        nearest(width, -std::numeric_limits<float>::infinity()) {}

  /// `row_seeds` may be empty: all are wanted.
  void add(std::span<const Rgb8> row, std::span<const float> disparity, std::span<const std::uint8_t> row_seeds) {
    const std::uint8_t* const from = &row.data()->r;
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = static_cast<std::uint16_t>(colours[i] + from[i]);
    for (std::size_t i = 0; i < row_seeds.size(); ++i) seeds[i] |= row_seeds[i];
    for (std::size_t i = 0; i < farthest.size(); ++i) farthest[i] = std::min(farthest[i], disparity[i]);
    for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = std::max(nearest[i], disparity[i]);
  }

  std::vector<std::uint16_t> colours;  ///< by channel
  std::vector<std::uint8_t> seeds;     ///< any
  std::vector<float> farthest, nearest;
};

/// Divides sums of so many values, rounded; without a division, which would take longer than all else.
class Mean {
 public:
  explicit Mean(int values)
      : half_(static_cast<std::uint32_t>(values / 2)), factor_((std::uint64_t{1} << 32) / values + 1) {}
  std::uint8_t operator()(std::uint32_t sum) const { return static_cast<std::uint8_t>((sum + half_) * factor_ >> 32); }

 private:
  std::uint32_t half_;
  std::uint64_t factor_;
};

/// The part of the pictures that one reduced pixel stands for.
struct Block {
  int left, top, size;

  /// Calls `visit(x, y)` for its pixels.
  template <class Visit>
  void visit_pixels(Visit visit) const {
    for (int y = top; y < top + size; ++y)
      for (int x = left; x < left + size; ++x) visit(x, y);
  }
};

/// The farthest disparity of the wanted pixels, or of all where none is.
float farthest_wanted(const Block& block, ImageView<const float> disparity, ImageView<const std::uint8_t> seeds) {
  constexpr float nowhere = std::numeric_limits<float>::infinity();
  float wanted = nowhere, farthest = nowhere;
  block.visit_pixels([&](int x, int y) {
    farthest = std::min(farthest, disparity(x, y));
    if (!seeds.empty() && seeds(x, y) != 0) wanted = std::min(wanted, disparity(x, y));
  });
  return wanted < nowhere ? wanted : farthest;
}

/// The mean colour of one of a block's surfaces.
Rgb8 colour_of_surface(const Block& block, ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                       float surface) {
  int count = 0, red = 0, green = 0, blue = 0;
  block.visit_pixels([&](int x, int y) {
    if (std::abs(disparity(x, y) - surface) > one_surface_px) return;
    const Rgb8 colour = photograph(x, y);
    red += colour.r;
    green += colour.g;
    blue += colour.b;
    ++count;
  });
  const auto mean = [count](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  return {mean(red), mean(green), mean(blue)};
}

struct WholeView {
  ImageView<const Rgb8> photograph;
  ImageView<const float> disparity;
  ImageView<const std::uint8_t> seeds;
  int left_out_px;
};

/// Notes the wanted pixels of a block, cut off by the picture's edge, that lie before a surface.
void leave_out(const Block& block, const WholeView& view, float surface, std::vector<ReducedView::LeftOut>& left_out) {
  const int step = view.left_out_px;
  const int right = std::min(block.left + block.size, view.seeds.width());
  const int bottom = std::min(block.top + block.size, view.seeds.height());
  for (int top = block.top; top < bottom; top += step) {
    for (int left = block.left; left < right; left += step) {
      ReducedView::LeftOut mean{};
      float count = 0;
      for (int y = top; y < std::min(top + step, bottom); ++y) {
        for (int x = left; x < std::min(left + step, right); ++x) {
          if (view.seeds(x, y) == 0 || view.disparity(x, y) - surface <= one_surface_px) continue;
          mean.x += static_cast<float>(x) + 0.5f;
          mean.y += static_cast<float>(y) + 0.5f;
          mean.disparity = count > 0 ? std::max(mean.disparity, view.disparity(x, y)) : view.disparity(x, y);
          mean.colour = view.photograph(x, y);
          ++count;
        }
      }
      if (count > 0) left_out.push_back({mean.x / count, mean.y / count, mean.disparity, mean.colour});
    }
  }
}

/// Makes one row of a smaller view. `known_reduction` is the reduction, or 0: loops of a known length are fast.
template <int known_reduction>
void reduce_row(const WholeView& whole, const Mean& mean, int y, ReducedView& view,
                std::vector<ReducedView::LeftOut>& left_out) {
  const int reduction = known_reduction > 0 ? known_reduction : view.reduction, width = view.photograph.width();
  const bool all_wanted = whole.seeds.empty();
  const auto columns = static_cast<std::size_t>(width) * static_cast<std::size_t>(reduction);
  RowSums sums(columns);
  for (int row = reduction * y; row < reduction * (y + 1); ++row)
    sums.add(whole.photograph.row(row).first(columns), whole.disparity.row(row).first(columns),
             all_wanted ? std::span<const std::uint8_t>() : whole.seeds.row(row).first(columns));
  const auto from_disparity = whole.disparity.row(reduction * y);
  const auto to_colours = view.photograph.row(y);
  const auto to_disparity = view.disparity.row(y);
  for (int x = 0; x < width; ++x) {
    std::uint32_t red = 0, green = 0, blue = 0;
    const std::size_t begin = static_cast<std::size_t>(x) * static_cast<std::size_t>(reduction);
    float farthest = sums.farthest[begin], nearest = sums.nearest[begin];
    for (std::size_t column = begin; column < begin + static_cast<std::size_t>(reduction); ++column) {
      red += sums.colours[3 * column];
      green += sums.colours[3 * column + 1];
      blue += sums.colours[3 * column + 2];
      farthest = std::min(farthest, sums.farthest[column]);
      nearest = std::max(nearest, sums.nearest[column]);
    }
    to_colours[x] = {mean(red), mean(green), mean(blue)};
    float surface = from_disparity[begin];
    if (nearest - farthest > one_surface_px) {
      const Block block{reduction * x, reduction * y, reduction};
      surface = farthest_wanted(block, whole.disparity, whole.seeds);
      to_colours[x] = colour_of_surface(block, whole.photograph, whole.disparity, surface);
      if (!all_wanted) leave_out(block, whole, surface, left_out);
    }
    to_disparity[x] = surface / static_cast<float>(reduction);
  }
  if (all_wanted) return;
  const auto to_seeds = view.seeds.row(y);
  for (std::size_t column = 0; column < columns; ++column)
    to_seeds[column / static_cast<std::size_t>(reduction)] |= sums.seeds[column];
}

/// The rows and columns at the end that make no whole block.
void leave_out_rest(const WholeView& view, int reduction, std::vector<ReducedView::LeftOut>& left_out) {
  constexpr float nothing = -std::numeric_limits<float>::infinity();
  const int width = view.seeds.width() / reduction * reduction, height = view.seeds.height() / reduction * reduction;
  if (width < view.seeds.width())
    for (int y = 0; y < height; y += reduction) leave_out({width, y, reduction}, view, nothing, left_out);
  if (height < view.seeds.height())
    for (int x = 0; x < view.seeds.width(); x += reduction) leave_out({x, height, reduction}, view, nothing, left_out);
}

}  // namespace

ReducedView reduced(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                    ImageView<const std::uint8_t> seeds, int reduction, int left_out_px) {
  const int width = photograph.width() / reduction, height = photograph.height() / reduction;
  ReducedView view{reduction, Image<Rgb8>(width, height), Image<float>(width, height),
                   seeds.empty() ? Image<std::uint8_t>() : Image<std::uint8_t>(width, height)};
  view.left_out_px = left_out_px;
  const WholeView whole{photograph, disparity, seeds, left_out_px};
  const Mean mean(reduction * reduction);
  std::vector<std::vector<ReducedView::LeftOut>> left_out(height);
  tbb::parallel_for(0, height, [&](int y) {
    if (reduction == 2) {
      reduce_row<2>(whole, mean, y, view, left_out[y]);
    } else if (reduction == 4) {
      reduce_row<4>(whole, mean, y, view, left_out[y]);
    } else {
      reduce_row<0>(whole, mean, y, view, left_out[y]);
    }
  });
  for (const std::vector<ReducedView::LeftOut>& of_row : left_out)
    view.left_out.insert(view.left_out.end(), of_row.begin(), of_row.end());
  if (!seeds.empty()) leave_out_rest(whole, reduction, view.left_out);
  return view;
}

}  // namespace wheatstone
