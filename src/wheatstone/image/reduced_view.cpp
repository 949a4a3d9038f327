#include "wheatstone/image/reduced_view.h"

#include <tbb/parallel_for.h>

#include <cstdint>
#include <span>
#include <vector>

namespace wheatstone {
namespace {

/// Sums of as many neighbouring rows as a picture is reduced by.
struct RowSums {
  explicit RowSums(std::size_t width) : colours(3 * width), seeds(width) {}

  void add(std::span<const Rgb8> row, std::span<const std::uint8_t> row_seeds) {
    const std::uint8_t* const from = &row.data()->r;
    for (std::size_t i = 0; i < colours.size(); ++i) colours[i] = static_cast<std::uint16_t>(colours[i] + from[i]);
    for (std::size_t i = 0; i < seeds.size(); ++i) seeds[i] |= row_seeds[i];
  }

  std::vector<std::uint16_t> colours;  ///< by channel
  std::vector<std::uint8_t> seeds;     ///< any
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

}  // namespace

ReducedView reduced(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                    ImageView<const std::uint8_t> seeds, int reduction) {
  const int width = photograph.width() / reduction, height = photograph.height() / reduction;
  ReducedView view{reduction, Image<Rgb8>(width, height), Image<float>(width, height),
                   Image<std::uint8_t>(width, height)};
  const Mean mean(reduction * reduction);
  tbb::parallel_for(0, height, [&](int y) {
    const auto columns = static_cast<std::size_t>(width * reduction);
    RowSums sums(columns);
    for (int row = reduction * y; row < reduction * (y + 1); ++row)
      sums.add(photograph.row(row).first(columns), seeds.row(row).first(columns));
    const auto from_disparity = disparity.row(reduction * y);
    const auto to_colours = view.photograph.row(y);
    const auto to_seeds = view.seeds.row(y);
    for (int x = 0, from = 0; x < width; ++x) {
      std::uint32_t red = 0, green = 0, blue = 0;
      for (const int end = from + reduction; from < end; ++from) {
        const auto column = static_cast<std::size_t>(from);
        red += sums.colours[3 * column];
        green += sums.colours[3 * column + 1];
        blue += sums.colours[3 * column + 2];
        to_seeds[x] |= sums.seeds[column];
      }
      to_colours[x] = {mean(red), mean(green), mean(blue)};
      view.disparity(x, y) = from_disparity[reduction * x] / static_cast<float>(reduction);
    }
  });
  return view;
}

}  // namespace wheatstone
