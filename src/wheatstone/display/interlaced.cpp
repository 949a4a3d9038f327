#include "wheatstone/display/interlaced.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

constexpr std::array<InterlacingName, 3> names{{
    {Interlacing::rows, "even-odd-rows", "irl"},
    {Interlacing::columns, "even-odd-columns", "icl"},
    {Interlacing::checkerboard, "checkerboard", "chl"},
}};

}  // namespace

std::span<const InterlacingName> interlacing_names() { return names; }

Interlacing find_interlacing(std::string_view name) {
  std::string known;
  for (const InterlacingName& entry : names) {
    if (name == entry.name || name == entry.ffmpeg) return entry.interlacing;
    known += fmt::format(" {} ({})", entry.name, entry.ffmpeg);
  }
  throw Error(ErrorKind::wrong_usage, fmt::format("no interlacing '{}', expected one of:{}", name, known));
}

int view_of_pixel(Interlacing interlacing, int x, int y) {
  switch (interlacing) {
    case Interlacing::rows:
      return y & 1;
    case Interlacing::columns:
      return x & 1;
    case Interlacing::checkerboard:
      break;
  }
  return (x ^ y) & 1;
}

Image<Rgb8> interlaced(ImageView<const Rgb8> left, ImageView<const Rgb8> right, Interlacing interlacing) {
  if (!same_size(left, right))
    throw Error(ErrorKind::wrong_usage, fmt::format("views of {}x{} and {}x{} pixels, expected one size", left.width(),
                                                    left.height(), right.width(), right.height()));
  Image<Rgb8> picture(left.width(), left.height());
  tbb::parallel_for(0, left.height(), [&](int y) {
    const std::array<std::span<const Rgb8>, 2> views{left.row(y), right.row(y)};
    const std::span<Rgb8> to = picture.row(y);
    // What the first two pixels of a row show, all of its even and odd ones do.
    for (const int first : {0, 1}) {
      const std::span<const Rgb8> from = views[view_of_pixel(interlacing, first, y)];
      for (std::size_t x = first; x < to.size(); x += 2) to[x] = from[x];
    }
  });
  return picture;
}

}  // namespace wheatstone
