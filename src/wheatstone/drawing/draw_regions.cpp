#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/drawing/prepared_painting_internal.h"

namespace wheatstone {
namespace {

/// Samples a pixel's side: each belongs to one mark, so that neighbours leave no seam between them.
constexpr int samples = 4;
constexpr int rows_a_band = 8;
constexpr int band_lines = rows_a_band * samples;
constexpr float hides_px = 1;  ///< of disparity, by which something must be nearer to hide a later mark
constexpr std::uint32_t nothing = ~std::uint32_t{0};

struct Crossing {
  float x, disparity;
};

/// A point as the view sees it.
struct Seen {
  float x, y, disparity;
};

/// Samples of a few rows.
struct Band {
  Band(int first_row, int width_px)
      : first_line(first_row * samples),
        columns(width_px * samples),
        disparity(static_cast<std::size_t>(columns) * band_lines, -std::numeric_limits<float>::infinity()),
        mark(disparity.size(), nothing),
        is_of_reference(disparity.size(), std::uint8_t{0}),
        crossings(band_lines) {}

  int first_line, columns;
  std::vector<float> disparity;  ///< of the nearest mark; at first, of the last that a surface hides
  std::vector<std::uint32_t> mark;
  std::vector<std::uint8_t> is_of_reference;  ///< not 0 where marks of other views only fill gaps
  std::vector<std::vector<Crossing>> crossings;
};

/// First sample whose centre lies at or after a place.
int first_sample(float place, int low, int high) {
  return static_cast<int>(
      std::clamp(std::ceil(place * samples - 0.5f), static_cast<float>(low), static_cast<float>(high)));
}

/// The farthest of the surfaces that are seen at a pixel and beside it.
float farthest_about(const ImageView<const float>& surface, int x, int y) {
  float farthest = std::numeric_limits<float>::infinity();
  for (int row = std::max(y - 1, 0); row <= std::min(y + 1, surface.height() - 1); ++row)
    for (int column = std::max(x - 1, 0); column <= std::min(x + 1, surface.width() - 1); ++column) {
      const float disparity = surface(column, row);
      if (std::isnan(disparity)) return disparity;
      farthest = std::min(farthest, disparity);
    }
  return farthest;
}

/// Notes what the surface hides in the band's samples. Outlines are smoother than surfaces: where a near one falls
/// short of its surface's edge by a pixel, the farther one beside it goes on.
void hide(const Hiding& hiding, int first_row, Band& band) {
  if (hiding.surface.empty()) return;
  for (int row = 0; row < rows_a_band && first_row + row < hiding.surface.height(); ++row) {
    const std::size_t begin = static_cast<std::size_t>(row * samples) * static_cast<std::size_t>(band.columns);
    float* below = band.disparity.data() + begin;
    std::uint8_t* of_reference = band.is_of_reference.data() + begin;
    for (int x = 0; x * samples < band.columns; ++x) {
      const int y = first_row + row;
      const std::ptrdiff_t offset = std::ptrdiff_t{x} * samples;
      std::fill_n(below + offset, samples,
                  least_seen_disparity(farthest_about(hiding.surface, x, y), hiding.tolerance_px) + hides_px);
      const bool is_reference = !hiding.reference.empty() &&
                                is_of_reference(hiding.surface(x, y), hiding.reference(x, y), hiding.tolerance_px);
      std::fill_n(of_reference + offset, samples, static_cast<std::uint8_t>(is_reference ? 1 : 0));
    }
    for (int line = 1; line < samples; ++line) {
      std::copy_n(below, band.columns, below + static_cast<std::ptrdiff_t>(line) * band.columns);
      std::copy_n(of_reference, band.columns, of_reference + static_cast<std::ptrdiff_t>(line) * band.columns);
    }
  }
}

void cross(Seen a, Seen b, Band& band) {
  // Neighbouring marks share edges: both must find the same crossings, whichever way round they go.
  if (b.y < a.y || (b.y == a.y && b.x < a.x)) std::swap(a, b);
  const int end = first_sample(b.y, band.first_line, band.first_line + band_lines);
  for (int line = first_sample(a.y, band.first_line, band.first_line + band_lines); line < end; ++line) {
    const float t = ((static_cast<float>(line) + 0.5f) / samples - a.y) / (b.y - a.y);
    band.crossings[line - band.first_line].push_back(
        {a.x + t * (b.x - a.x), a.disparity + t * (b.disparity - a.disparity)});
  }
}

/// A mark of the reference view, or of another one.
struct IndexedMark {
  std::uint32_t index;
  bool is_own;
};

void fill_between(const Crossing& from, const Crossing& to, int line, IndexedMark mark, Band& band) {
  const float slope = to.x > from.x ? (to.disparity - from.disparity) / (to.x - from.x) : 0;
  const std::size_t row = static_cast<std::size_t>(line) * static_cast<std::size_t>(band.columns);
  const int end = first_sample(to.x, 0, band.columns);
  for (int i = first_sample(from.x, 0, band.columns); i < end; ++i) {
    const float disparity = from.disparity + slope * ((static_cast<float>(i) + 0.5f) / samples - from.x);
    const std::size_t at = row + static_cast<std::size_t>(i);
    if (disparity < band.disparity[at] - hides_px) continue;
    if (!mark.is_own && band.is_of_reference[at] != 0 && band.mark[at] != nothing) continue;
    band.disparity[at] = disparity;
    band.mark[at] = mark.index;
  }
}

void draw_mark(const RegionPainting& painting, IndexedMark of, ViewPosition view, Band& band) {
  const RegionMark& mark = painting.marks[of.index];
  const auto seen = [&](const ControlPoint& p) {
    return Seen{x_in_view(p, mark.reference_view, view), p.y, p.disparity};
  };
  for (const Ring& ring : painting.rings_of(mark)) {
    const auto points = painting.points_of(ring);
    for (std::size_t i = 0; i < points.size(); ++i)
      cross(seen(points[i]), seen(points[i + 1 < points.size() ? i + 1 : 0]), band);
  }
  for (int line = 0; line < band_lines; ++line) {
    std::vector<Crossing>& crossings = band.crossings[line];
    std::ranges::sort(crossings, {}, &Crossing::x);
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2)
      fill_between(crossings[i], crossings[i + 1], line, of, band);
    crossings.clear();
  }
}

/// The mean of the samples of a pixel that marks cover, and how many they are.
struct Pixel {
  Rgb8 colour;
  int covered = 0;
  float disparity = 0;
};

Pixel pixel_of(const RegionPainting& painting, const Band& band, int row, int x) {
  int red = 0, green = 0, blue = 0;
  Pixel pixel;
  for (int line = row * samples; line < (row + 1) * samples; ++line) {
    for (int i = x * samples; i < (x + 1) * samples; ++i) {
      const std::size_t at =
          static_cast<std::size_t>(line) * static_cast<std::size_t>(band.columns) + static_cast<std::size_t>(i);
      if (band.mark[at] == nothing) continue;
      const Rgb8 colour = painting.marks[band.mark[at]].colour;
      red += colour.r;
      green += colour.g;
      blue += colour.b;
      pixel.disparity += band.disparity[at];
      ++pixel.covered;
    }
  }
  if (pixel.covered == 0) return pixel;
  const auto mean = [&](int sum) { return static_cast<std::uint8_t>((sum + pixel.covered / 2) / pixel.covered); };
  pixel.colour = {mean(red), mean(green), mean(blue)};
  pixel.disparity /= static_cast<float>(pixel.covered);
  return pixel;
}

/// Writes a row, its gaps filled from the farther side, and returns how many pixels are bare.
std::size_t finish_row(std::span<const Pixel> pixels, std::span<Rgb8> to, std::span<std::uint8_t> bare) {
  std::size_t count = 0;
  const Pixel* before = nullptr;
  for (std::size_t x = 0; x < pixels.size();) {
    std::size_t end = x;
    while (end < pixels.size() && pixels[end].covered == 0) ++end;
    const Pixel* after = end < pixels.size() ? &pixels[end] : nullptr;
    const Pixel* from =
        before == nullptr || (after != nullptr && after->disparity < before->disparity) ? after : before;
    for (; x < end; ++x)
      if (from != nullptr) to[x] = from->colour;
    if (after == nullptr) break;
    to[end] = after->colour;
    before = after;
    x = end + 1;
  }
  for (std::size_t x = 0; x < pixels.size(); ++x) {
    const bool is_bare = pixels[x].covered < samples * samples / 2;
    bare[x] = is_bare ? 255 : 0;
    count += is_bare ? 1 : 0;
  }
  return count;
}

/// For every band, the marks that touch it, in drawing order.
std::vector<std::vector<std::uint32_t>> marks_by_band(const RegionPainting& painting, ViewPosition view) {
  std::vector<std::vector<std::uint32_t>> bands((painting.height + rows_a_band - 1) / rows_a_band);
  const auto last_row = static_cast<float>(painting.height - 1);
  for (std::uint32_t m = 0; m < painting.marks.size(); ++m) {
    const RegionMark& mark = painting.marks[m];
    if (!mark.views.contains(view)) continue;
    float top = std::numeric_limits<float>::infinity(), bottom = -top;
    for (const Ring& ring : painting.rings_of(mark)) {
      for (const ControlPoint& point : painting.points_of(ring)) {
        top = std::min(top, point.y);
        bottom = std::max(bottom, point.y);
      }
    }
    if (!(bottom >= 0 && top <= last_row + 1)) continue;
    const int first = static_cast<int>(std::clamp(top, 0.f, last_row)) / rows_a_band;
    const int last = static_cast<int>(std::clamp(bottom, 0.f, last_row)) / rows_a_band;
    for (int band = first; band <= last; ++band) bands[band].push_back(m);
  }
  return bands;
}

DrawnView draw_view(const RegionPainting& painting, ViewPosition view, const Hiding& hiding) {
  DrawnView drawn{Image<Rgb8>(painting.width, painting.height), 0,
                  Image<std::uint8_t>(painting.width, painting.height)};
  if (drawn.picture.empty()) return drawn;
  const auto marks = marks_by_band(painting, view);
  std::vector<std::size_t> bare(marks.size());
  tbb::parallel_for(std::size_t{0}, marks.size(), [&](std::size_t i) {
    const int first_row = static_cast<int>(i) * rows_a_band;
    Band band(first_row, painting.width);
    hide(hiding, first_row, band);
    for (const bool own : {true, false})
      for (const std::uint32_t mark : marks[i])
        if (hiding.is_own(painting.marks[mark].reference_view) == own) draw_mark(painting, {mark, own}, view, band);
    std::vector<Pixel> pixels(static_cast<std::size_t>(painting.width));
    for (int row = 0; row < rows_a_band && first_row + row < painting.height; ++row) {
      for (int x = 0; x < painting.width; ++x) pixels[static_cast<std::size_t>(x)] = pixel_of(painting, band, row, x);
      bare[i] += finish_row(pixels, drawn.picture.row(first_row + row), drawn.bare.row(first_row + row));
    }
  });
  std::size_t bare_pixels = 0;
  for (const std::size_t count : bare) bare_pixels += count;
  drawn.bare_share = static_cast<double>(bare_pixels) / static_cast<double>(drawn.picture.pixels().size());
  return drawn;
}

}  // namespace

void draw_marks(const RegionPainting& painting, const Surfaces& surfaces, std::span<const ViewToDraw> views) {
  tbb::parallel_for(std::size_t{0}, views.size(), [&](std::size_t i) {
    const SeenSurfaces seen = seen_surfaces(surfaces, views[i].position, {painting.width, 0, painting.height});
    views[i].drawn = draw_view(painting, views[i].position, seen.hiding);
  });
}

}  // namespace wheatstone
