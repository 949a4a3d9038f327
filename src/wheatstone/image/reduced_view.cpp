#include "wheatstone/image/reduced_view.h"

#include <tbb/parallel_for.h>

#include <vector>

namespace wheatstone {
namespace {

struct Sum {
  int red = 0, green = 0, blue = 0;
};

}  // namespace

ReducedView reduced(ImageView<const Rgb8> photograph, ImageView<const float> disparity,
                    ImageView<const std::uint8_t> seeds, int reduction) {
  const int width = photograph.width() / reduction, height = photograph.height() / reduction;
  ReducedView view{reduction, Image<Rgb8>(width, height), Image<float>(width, height),
                   Image<std::uint8_t>(width, height)};
  const int pixels = reduction * reduction;
  const auto mean = [=](int sum) { return static_cast<std::uint8_t>((sum + pixels / 2) / pixels); };
  tbb::parallel_for(0, height, [&](int y) {
    std::vector<Sum> sums(static_cast<std::size_t>(width));
    const auto to_seeds = view.seeds.row(y);
    for (int row = reduction * y; row < reduction * (y + 1); ++row) {
      const auto colours = photograph.row(row);
      const auto from_seeds = seeds.row(row);
      for (int x = 0, from = 0; x < width; ++x) {
        Sum& sum = sums[static_cast<std::size_t>(x)];
        for (const int end = from + reduction; from < end; ++from) {
          sum.red += colours[from].r;
          sum.green += colours[from].g;
          sum.blue += colours[from].b;
          to_seeds[x] |= from_seeds[from];
        }
      }
    }
    const auto from_disparity = disparity.row(reduction * y);
    for (int x = 0; x < width; ++x) {
      const Sum& sum = sums[static_cast<std::size_t>(x)];
      view.photograph(x, y) = {mean(sum.red), mean(sum.green), mean(sum.blue)};
      view.disparity(x, y) = from_disparity[reduction * x] / static_cast<float>(reduction);
    }
  });
  return view;
}

}  // namespace wheatstone
