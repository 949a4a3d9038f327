#include "wheatstone/stereo/view_scale.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

namespace wheatstone {
namespace {

constexpr float mixed_surfaces_px = 1;

/// Some neighbouring rows, by columns: sums of the colours, whether any pixel is wanted, and the range of disparities.
struct RowSums {
  explicit RowSums(std::size_t width)
      : colours(3 * width),
        wanted(width),
        farthest(width, std::numeric_limits<float>::infinity()),
        nearest(width, -std::numeric_limits<float>::infinity()) {}

  /// `row_wanted` may be empty: all are wanted.
  void add(std::span<const Rgb8> row, std::span<const float> disparity, std::span<const std::uint8_t> row_wanted) {
    const std::uint8_t* const from = &row.data()->r;
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = static_cast<std::uint16_t>(colours[i] + from[i]);
    for (std::size_t i = 0; i < row_wanted.size(); ++i) wanted[i] |= row_wanted[i];
    for (std::size_t i = 0; i < farthest.size(); ++i) farthest[i] = std::min(farthest[i], disparity[i]);
    for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = std::max(nearest[i], disparity[i]);
  }

  std::vector<std::uint16_t> colours;  ///< by channel
  std::vector<std::uint8_t> wanted;    ///< any
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
float farthest_wanted(const Block& block, ImageView<const float> disparity, ImageView<const std::uint8_t> mask) {
  constexpr float nowhere = std::numeric_limits<float>::infinity();
  float wanted = nowhere, farthest = nowhere;
  block.visit_pixels([&](int x, int y) {
    farthest = std::min(farthest, disparity(x, y));
    if (!mask.empty() && mask(x, y) != 0) wanted = std::min(wanted, disparity(x, y));
  });
  return wanted < nowhere ? wanted : farthest;
}

/// The mean colour of one of a block's surfaces.
Rgb8 colour_of_surface(const Block& block, ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                       float surface) {
  int count = 0, red = 0, green = 0, blue = 0;
  block.visit_pixels([&](int x, int y) {
    if (std::abs(disparity(x, y) - surface) > mixed_surfaces_px) return;
    const Rgb8 colour = photograph(x, y);
    red += colour.r;
    green += colour.g;
    blue += colour.b;
    ++count;
  });
  const auto mean = [count](int sum) { return static_cast<std::uint8_t>((sum + count / 2) / count); };
  return {mean(red), mean(green), mean(blue)};
}

/// The three images of a view that is being made.
struct Planes {
  Planes(int width, int height, bool has_mask)
      : colour(width, height),
        disparity(width, height),
        wanted(has_mask ? Image<std::uint8_t>(width, height) : Image<std::uint8_t>()) {}

  View view_of(const View& source, int scale) && {
    return {
        std::move(colour), std::move(disparity), std::move(wanted), source.position, {source.frame.origin_px, scale},
        source.continued};
  }

  Image<Rgb8> colour;
  Image<float> disparity;
  Image<std::uint8_t> wanted;
};

/// Takes the first pixel of each block of factor by factor pixels, which is enough for a smooth map.
Image<std::uint8_t> every_nth(ImageView<const std::uint8_t> map, int factor, int width, int height) {
  Image<std::uint8_t> smaller(width, height);
  for (int y = 0; y < height; ++y) {
    const auto from = map.row(factor * y);
    const auto to = smaller.row(y);
    for (std::size_t x = 0; x < to.size(); ++x) to[x] = from[static_cast<std::size_t>(factor) * x];
  }
  return smaller;
}

/// Makes one row of a smaller view. `known_factor` is the factor, or 0: loops of a known length are fast.
template <int known_factor>
void make_smaller_row(const View& view, int any_factor, const Mean& mean, int y, Planes& smaller) {
  const int factor = known_factor > 0 ? known_factor : any_factor, width = smaller.colour.width();
  const bool all_wanted = view.wanted.empty();
  const auto columns = static_cast<std::size_t>(width) * static_cast<std::size_t>(factor);
  RowSums sums(columns);
  for (int row = factor * y; row < factor * (y + 1); ++row)
    sums.add(view.colour.row(row).first(columns), view.disparity.row(row).first(columns),
             all_wanted ? std::span<const std::uint8_t>() : view.wanted.row(row).first(columns));
  const auto from_disparity = view.disparity.row(factor * y);
  const auto to_colours = smaller.colour.row(y);
  const auto to_disparity = smaller.disparity.row(y);
  for (int x = 0; x < width; ++x) {
    std::uint32_t red = 0, green = 0, blue = 0;
    const std::size_t begin = static_cast<std::size_t>(x) * static_cast<std::size_t>(factor);
    float farthest = sums.farthest[begin], nearest = sums.nearest[begin];
    for (std::size_t column = begin; column < begin + static_cast<std::size_t>(factor); ++column) {
      red += sums.colours[3 * column];
      green += sums.colours[3 * column + 1];
      blue += sums.colours[3 * column + 2];
      farthest = std::min(farthest, sums.farthest[column]);
      nearest = std::max(nearest, sums.nearest[column]);
    }
    to_colours[x] = {mean(red), mean(green), mean(blue)};
    float surface = from_disparity[begin];
    if (nearest - farthest > mixed_surfaces_px) {
      const Block block{factor * x, factor * y, factor};
      surface = farthest_wanted(block, view.disparity, view.wanted);
      to_colours[x] = colour_of_surface(block, view.colour, view.disparity, surface);
    }
    to_disparity[x] = surface / static_cast<float>(factor);
  }
  if (all_wanted) return;
  const auto to_wanted = smaller.wanted.row(y);
  for (std::size_t column = 0; column < columns; ++column)
    to_wanted[column / static_cast<std::size_t>(factor)] |= sums.wanted[column];
}

}  // namespace

View smaller_view(const View& view, int factor) {
  if (factor == 1) return view;
  const int width = view.colour.width() / factor, height = view.colour.height() / factor;
  Planes smaller(width, height, !view.wanted.empty());
  const Mean mean(factor * factor);
  tbb::parallel_for(0, height, [&](int y) {
    if (factor == 2) {
      make_smaller_row<2>(view, factor, mean, y, smaller);
    } else if (factor == 4) {
      make_smaller_row<4>(view, factor, mean, y, smaller);
    } else {
      make_smaller_row<0>(view, factor, mean, y, smaller);
    }
  });
  View made = std::move(smaller).view_of(view, view.frame.scale * factor);
  if (!view.detail.empty()) made.detail = every_nth(view.detail, factor, width, height);
  return made;
}

View larger_view(const View& view, int factor, int width, int height) {
  if (factor == 1) return view;
  Planes larger(width, height, !view.wanted.empty());
  const int last_column = view.colour.width() - 1, rows = view.colour.height();
  const auto end_of = [=](int row) { return row + 1 < rows ? factor * (row + 1) : height; };
  const auto widen = [&](auto from, auto to, auto value_of) {
    for (int column = 0, x = 0; column <= last_column; ++column)
      for (const int end = column < last_column ? x + factor : width; x < end; ++x) to[x] = value_of(from[column]);
  };
  const auto same = [](auto value) { return value; };
  tbb::parallel_for(0, rows, [&](int row) {
    const int first = factor * row;
    widen(view.colour.row(row), larger.colour.row(first), same);
    widen(view.disparity.row(row), larger.disparity.row(first),
          [=](float disparity) { return disparity * static_cast<float>(factor); });
    if (!view.wanted.empty()) widen(view.wanted.row(row), larger.wanted.row(first), same);
    for (int y = first + 1; y < end_of(row); ++y) {
      std::ranges::copy(larger.colour.row(first), larger.colour.row(y).begin());
      std::ranges::copy(larger.disparity.row(first), larger.disparity.row(y).begin());
      if (!view.wanted.empty()) std::ranges::copy(larger.wanted.row(first), larger.wanted.row(y).begin());
    }
  });
  return std::move(larger).view_of(view, view.frame.scale / factor);
}

std::vector<View> at_reference_scale(std::span<const View> views) {
  const View& reference = views.front();
  std::vector<View> scene(views.begin(), views.end());
  for (View& view : scene)
    view = larger_view(view, view.frame.scale, reference.colour.width(), reference.colour.height());
  return scene;
}

}  // namespace wheatstone
