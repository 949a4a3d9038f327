// Packing views for a lenticular screen, against copies of the memory that is read and written.

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstring>
#include <vector>

#include "stopwatch.h"
#include "wheatstone/display/lenticular.h"

namespace wheatstone::bench {
namespace {

/// Every byte of every view into a copy of its own, by rows on all threads, and the screen once more.
double seconds_of_copies(const std::vector<Image<Rgb8>>& views, const Image<Rgb8>& screen) {
  std::vector<Image<Rgb8>> copies = views;
  Image<Rgb8> screen_copy = screen;
  const auto copy = [](const Image<Rgb8>& from, Image<Rgb8>& to) {
    tbb::parallel_for(0, from.height(),
                      [&](int y) { std::memcpy(to.row(y).data(), from.row(y).data(), from.row(y).size_bytes()); });
  };
  return median_seconds([&] {
    for (std::size_t v = 0; v < views.size(); ++v) copy(views[v], copies[v]);
    copy(screen, screen_copy);
  });
}

void compare(int count, int width, int height, const LenticularScreen& screen) {
  std::vector<Image<Rgb8>> views;
  for (int v = 0; v < count; ++v)
    views.emplace_back(width, height, Rgb8{static_cast<std::uint8_t>(v), static_cast<std::uint8_t>(5 * v), 9});
  Image<Rgb8> picture(screen.width, screen.height);
  const double packing = median_seconds([&] { interleave(views, screen, picture); });
  // The answer is checked before its time is printed.
  for (int y = 0; y < screen.height; y += 97)
    for (int x = 0; x < screen.width; x += 89)
      if (picture(x, y).r != static_cast<std::uint8_t>(view_of_subpixel(screen, count, x, y, 0))) {
        fmt::print("wrong at {}, {}\n", x, y);
        return;
      }
  const double copying = seconds_of_copies(views, picture);
  fmt::print(
      "{:2} views of {:4}x{:4} on {}x{}: {:6.1f} ms, copies of input and output {:6.1f} ms, ratio {:.2f} (limit 3)\n",
      count, width, height, screen.width, screen.height, 1e3 * packing, 1e3 * copying, packing / copying);
}

}  // namespace
}  // namespace wheatstone::bench

int main() {
  using wheatstone::bench::compare;
  wheatstone::LenticularScreen screen = wheatstone::find_lenticular("step-9");
  screen.width = 3840;
  screen.height = 2160;
  compare(9, 3840, 2160, screen);
  compare(9, 1280, 720, screen);
  compare(45, 819, 455, screen);
}
