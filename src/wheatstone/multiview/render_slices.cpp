#include "wheatstone/multiview/render_slices.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {
namespace {

constexpr int band_rows = 16;
// A pixel through which less comes than the tone map can show is full.
constexpr float full = 1.f / 1024;

/// What slices do to those behind them.
struct Hiding {
  bool any = false;
  bool sharp = true;  ///< a pixel hides all or nothing
};

Hiding hiding_of(const SliceStack& stack) {
  Hiding hiding;
  for (const Slice& slice : stack.slices)
    for (const LinearRgba& pixel : slice.pixels.pixels()) {
      hiding.any = hiding.any || pixel.a > 0;
      hiding.sharp = hiding.sharp && (pixel.a == 0 || pixel.a == 1);
    }
  return hiding;
}

/// Copies a slice's rows of one band to where the compositor reads them.
void take_rows(const Slice& slice, int top, LightBand& band) {
  const int first = std::max(top, slice.top);
  const int end = std::min(top + band.rows(), slice.top + slice.pixels.height());
  static_assert(sizeof(LinearRgba) == LightBand::most_channels * sizeof(float));
  for (int y = first; y < end; ++y) {
    const std::span<const LinearRgba> from = slice.pixels.row(y - slice.top);
    const int begin = std::max(slice.left, band.left());
    const int stop = std::min(slice.left + slice.pixels.width(), band.right());
    if (begin >= stop) return;
    band.note_light();
    std::memcpy(band.row(y - top) + (begin - band.left()) * LightBand::most_channels,
                from.data() + (begin - slice.left), sizeof(LinearRgba) * (stop - begin));
  }
}

struct Workplace {
  LightBand plane;
  SliceBand slices;
};

std::vector<float> parallaxes_of(const SliceStack& stack) {
  std::vector<float> parallaxes;
  for (const Slice& slice : stack.slices) parallaxes.push_back(slice.parallax_px);
  return parallaxes;
}

/// How far the views move the slices.
float largest_shift_px(const SliceStack& stack, std::span<const ViewPosition> views) {
  float largest = 0;
  for (const ViewPosition view : views)
    for (const Slice& slice : stack.slices)
      largest = std::max(largest, std::abs((view - central_view) * slice.parallax_px));
  return largest;
}

void add_glowing(const SliceStack& stack, const Rig& rig, const Compositing& compositing,
                 std::span<const ImageView<Rgb8>> pictures) {
  const ToneMap tone(stack.tone);
  const float gain = compositing.focus ? compositing.focus->largest_gain() : 1;
  const int around = static_cast<int>(std::ceil(largest_shift_px(stack, rig.positions) * gain)) + 2;
  const int planes = static_cast<int>(stack.slices.size());
  tbb::enumerable_thread_specific<Workplace> workplaces([&] {
    return Workplace{LightBand(-around, rig.width + around, band_rows, LightBand::most_channels),
                     SliceBand(-around, rig.width + around, band_rows, planes)};
  });
  std::vector<ViewTarget> targets;
  for (const ImageView<Rgb8> picture : pictures) targets.push_back({.picture = picture});
  tbb::parallel_for(0, (rig.height + band_rows - 1) / band_rows, [&](int b) {
    Workplace& work = workplaces.local();
    for (int plane = 0; plane < planes; ++plane) {
      take_rows(stack.slices[plane], b * band_rows, work.plane);
      work.slices.take(plane, work.plane);
    }
    composite(work.slices, compositing, tone, b * band_rows, targets);
  });
}

/// A pixel of a view, and how far it moves the slices for each pixel of their parallax.
struct ViewPixel {
  int x, y;
  float shift;
};

ViewPixel pixel_of(int x, int y, ViewPosition view, const std::optional<Focus>& focus) {
  const float gain = focus ? focus->gain_at(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) : 1;
  return {x, y, (view - central_view) * gain};
}

/// Light of one pixel of one view, front to back. Slices are read at their nearest pixel: opaque edges stay sharp.
LinearRgba look_through(const SliceStack& stack, const ViewPixel& pixel) {
  const auto [x, y, shift] = pixel;
  LinearRgba seen;
  float through = 1;
  for (const Slice& slice : stack.slices) {
    const int column = x - static_cast<int>(std::lround(shift * slice.parallax_px)) - slice.left;
    if (!slice.pixels.contains(column, y - slice.top)) continue;
    const LinearRgba& light = slice.pixels(column, y - slice.top);
    seen.r += through * light.r;
    seen.g += through * light.g;
    seen.b += through * light.b;
    through *= 1 - light.a;
    if (through < full) break;
  }
  return seen;
}

LinearRgba mixed(const LinearRgba& a, const LinearRgba& b, float share) {
  return {std::lerp(a.r, b.r, share), std::lerp(a.g, b.g, share), std::lerp(a.b, b.b, share),
          std::lerp(a.a, b.a, share)};
}

/// What a view sees at a pixel: the sum of all slices there, or what of them is not hidden. Slices are read between
/// their pixels.
LinearRgba look_between(const SliceStack& stack, const ViewPixel& pixel) {
  const auto [x, y, shift] = pixel;
  LinearRgba seen;
  float through = 1;
  for (const Slice& slice : stack.slices) {
    const int row = y - slice.top;
    if (row < 0 || row >= slice.pixels.height()) continue;
    const float at = static_cast<float>(x - slice.left) - shift * slice.parallax_px;
    const int column = static_cast<int>(std::floor(at));
    if (column < -1 || column >= slice.pixels.width()) continue;
    const std::span<const LinearRgba> pixels = slice.pixels.row(row);
    const LinearRgba here =
        mixed(column >= 0 ? pixels[column] : LinearRgba{},
              column + 1 < slice.pixels.width() ? pixels[column + 1] : LinearRgba{}, at - static_cast<float>(column));
    seen.r += through * here.r;
    seen.g += through * here.g;
    seen.b += through * here.b;
    through *= 1 - here.a;
    if (through < full) break;
  }
  return seen;
}

}  // namespace

std::vector<Image<Rgb8>> render_slices(const SliceStack& stack, const Rig& rig, SliceFilter filter,
                                       const Progress& progress, const std::optional<Focus>& focus) {
  check_views_fit(rig);
  if (focus) check_focus(*focus, largest_shift_px(stack, rig.positions));
  std::vector<Image<Rgb8>> views(rig.positions.size(), Image<Rgb8>(rig.width, rig.height));
  const std::vector<ImageView<Rgb8>> pictures(views.begin(), views.end());
  if (stack.slices.empty() || views.empty()) return views;
  const Hiding hiding = hiding_of(stack);
  if (!hiding.any) {
    const std::vector<float> parallaxes = parallaxes_of(stack);
    add_glowing(stack, rig, {parallaxes, rig.positions, resampling_of(filter), focus}, pictures);
  } else {
    const ToneMap tone(stack.tone);
    const auto look = hiding.sharp || filter == SliceFilter::nearest ? look_through : look_between;
    tbb::parallel_for(0, rig.height, [&](int y) {
      for (std::size_t v = 0; v < views.size(); ++v)
        for (int x = 0; x < rig.width; ++x) {
          const LinearRgba seen = look(stack, pixel_of(x, y, rig.positions[v], focus));
          views[v](x, y) = tone(seen.r, seen.g, seen.b);
        }
    });
  }
  report(progress, "views", 1);
  return views;
}

InterleavedView render_interleaved(const SliceStack& stack, std::span<const ViewPosition> views,
                                   const ViewsOfRow& views_of_row, const Progress& progress,
                                   const std::optional<Focus>& focus) {
  if (focus) check_focus(*focus, largest_shift_px(stack, views));
  InterleavedView result{.picture = Image<Rgb8>(stack.width, stack.height), .composited = 0};
  const ToneMap tone(stack.tone);
  std::atomic<std::uint64_t> composited = 0;
  tbb::parallel_for(0, stack.height, [&](int y) {
    std::vector<std::uint16_t> shown(3 * static_cast<std::size_t>(stack.width));
    views_of_row(y, shown);
    for (int x = 0; x < stack.width; ++x) {
      const std::uint16_t* const view = shown.data() + 3 * static_cast<std::size_t>(x);
      const auto colour_of = [&](std::uint16_t of_view) {
        const LinearRgba seen = look_between(stack, pixel_of(x, y, views[of_view], focus));
        return tone(seen.r, seen.g, seen.b);
      };
      const Rgb8 red = colour_of(view[0]);
      const Rgb8 green = view[1] == view[0] ? red : colour_of(view[1]);
      const Rgb8 blue = view[2] == view[1] ? green : colour_of(view[2]);
      result.picture(x, y) = {red.r, green.g, blue.b};
    }
    composited += 3 * static_cast<std::uint64_t>(stack.width);
  });
  result.composited = composited;
  report(progress, "views", 1);
  return result;
}

void map_depth(SliceStack& stack, float nearest_px, float farthest_px) {
  if (stack.slices.empty()) return;
  const float first = stack.slices.front().parallax_px;
  const float range = stack.slices.back().parallax_px - first;
  for (Slice& slice : stack.slices) {
    const float share = range > 0 ? (slice.parallax_px - first) / range : 0.5f;
    slice.parallax_px = nearest_px + share * (farthest_px - nearest_px);
  }
}

}  // namespace wheatstone
