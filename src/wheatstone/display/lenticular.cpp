#include "wheatstone/display/lenticular.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "wheatstone/display/lenticular_internal.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

/// A part of a lens, in 2^64ths.
std::uint64_t part_of_lens(double lenses) { return static_cast<std::uint64_t>((lenses - std::floor(lenses)) * 0x1p64); }

void check(std::span<const Image<Rgb8>> views) {
  if (views.empty()) throw Error(ErrorKind::wrong_usage, "no views to interleave");
  for (const Image<Rgb8>& view : views)
    if (!same_size(view, views.front()) || view.empty())
      throw Error(ErrorKind::wrong_usage, "the views to interleave must be of one size");
  if (views.size() > 0xFFFF) throw Error(ErrorKind::wrong_usage, "more than 65535 views to interleave");
}

/// One row: of each pixel the three bytes that its sub-pixels' views have there.
void take(std::span<const std::uint8_t* const> rows, std::span<const std::uint16_t> shown,
          std::span<const std::uint32_t> source, std::span<Rgb8> to) {
  const std::uint8_t* const* const row = rows.data();
  const std::uint16_t* view = shown.data();
  for (std::size_t x = 0; x < to.size(); ++x, view += 3) {
    const std::uint32_t at = source[x];
    to[x] = {row[view[0]][at], row[view[1]][at + 1], row[view[2]][at + 2]};
  }
}

}  // namespace

Phases phases_of_row(const LenticularScreen& screen, int y) {
  const double width = screen.width;
  const double lenses = screen.pitch * width / screen.dpi * std::cos(std::atan(1 / screen.slope));
  const double tilt = screen.height / (width * screen.slope) * (screen.flip ? -1 : 1);
  const double up = 1 - (y + 0.5) / screen.height;
  const Phases phases{part_of_lens((0.5 / width + up * tilt) * lenses - screen.center),
                      part_of_lens(lenses / (3 * width))};
  if (screen.first_from_left) return phases;
  // 1 − frac a, but for a bit; counted this way it is below 1 too where a is whole.
  return {~phases.first, ~phases.a_subpixel + 1};
}

int nearest_sample(int i, int count, int smaller) {
  return static_cast<int>((2 * static_cast<std::int64_t>(i) + 1) * smaller / (2 * static_cast<std::int64_t>(count)));
}

int view_of_subpixel(const LenticularScreen& screen, int views, int x, int y, int channel) {
  const Phases phases = phases_of_row(screen, y);
  const int place = screen.blue_first ? 2 - channel : channel;
  const auto from_left = 3 * static_cast<std::uint64_t>(x) + static_cast<std::uint64_t>(place);
  return view_at(phases.first + from_left * phases.a_subpixel, static_cast<std::uint32_t>(views));
}

void views_of_row(const LenticularScreen& screen, int views, int y, std::span<std::uint16_t> three_per_pixel) {
  views_of_phases(phases_of_row(screen, y), static_cast<std::uint32_t>(views), three_per_pixel);
  if (!screen.blue_first) return;
  for (std::size_t i = 0; i + 2 < three_per_pixel.size(); i += 3) std::swap(three_per_pixel[i], three_per_pixel[i + 2]);
}

void interleave(std::span<const Image<Rgb8>> views, const LenticularScreen& screen, ImageView<Rgb8> picture) {
  check(views);
  if (picture.width() != screen.width || picture.height() != screen.height)
    throw Error(ErrorKind::wrong_usage, "the picture must be of the screen's size");
  // Where in a row of a view, in bytes, each pixel of the screen is.
  std::vector<std::uint32_t> source(screen.width);
  for (int x = 0; x < screen.width; ++x)
    source[x] = static_cast<std::uint32_t>(3 * nearest_sample(x, screen.width, views.front().width()));

  tbb::parallel_for(tbb::blocked_range(0, screen.height, 8), [&](const tbb::blocked_range<int>& range) {
    std::vector<const std::uint8_t*> rows(views.size());
    std::vector<std::uint16_t> shown(3 * source.size());
    for (int y = range.begin(); y < range.end(); ++y) {
      const int row = nearest_sample(y, screen.height, views.front().height());
      for (std::size_t v = 0; v < views.size(); ++v) rows[v] = &views[v].row(row).data()->r;
      views_of_row(screen, static_cast<int>(views.size()), y, shown);
      take(rows, shown, source, picture.row(y));
    }
  });
}

Image<Rgb8> interleave(std::span<const Image<Rgb8>> views, const LenticularScreen& screen) {
  check(views);
  Image<Rgb8> picture(screen.width, screen.height);
  interleave(views, screen, picture);
  return picture;
}

}  // namespace wheatstone
