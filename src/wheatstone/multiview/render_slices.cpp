#include "wheatstone/multiview/render_slices.h"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {
namespace {

constexpr int band_rows = 16;

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

struct RenderedBand {
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

/// How slices are interpolated between their pixels. Opaque edges stay sharp. Slices with alpha are not read by cubic
/// weights, which can be negative.
SliceFilter filter_for(SliceHiding hiding, SliceFilter filter) {
  if (hiding == SliceHiding::nothing) return filter;
  return hiding == SliceHiding::sharply ? SliceFilter::nearest : std::min(filter, SliceFilter::linear);
}

/// How far the views move the slices, the focus among them. Throws Error{wrong_usage} where it would fold a view.
float checked_shift(const SliceStack& stack, std::span<const ViewPosition> views, const std::optional<Focus>& focus) {
  const float largest = largest_shift_px(stack, views);
  if (focus) check_focus(*focus, largest);
  return focus ? largest * focus->largest_gain() : largest;
}

/// Calls `composite_band(slices, compositing, tone, top)` for every band of views of a stack, in parallel. Throws
/// Error{wrong_usage} where the focus would fold a view.
template <class CompositeBand>
void composite_stack(const SliceStack& stack, std::span<const ViewPosition> views, SliceFilter filter,
                     const std::optional<Focus>& focus, CompositeBand composite_band) {
  const int around = static_cast<int>(std::ceil(checked_shift(stack, views, focus))) + 2;
  if (stack.slices.empty() || views.empty()) return;  // all is black
  const int planes = static_cast<int>(stack.slices.size());
  const SliceHiding hiding = hiding_of(stack);
  const std::vector<float> parallaxes = parallaxes_of(stack);
  const Compositing compositing{parallaxes, views, filter_for(hiding, filter), focus};
  const ToneMap tone(stack.tone);
  tbb::enumerable_thread_specific<RenderedBand> workplaces([&] {
    return RenderedBand{LightBand(-around, stack.width + around, band_rows, LightBand::most_channels),
                        SliceBand(-around, stack.width + around, band_rows, planes, hiding != SliceHiding::nothing)};
  });
  tbb::parallel_for(0, (stack.height + band_rows - 1) / band_rows, [&](int b) {
    RenderedBand& work = workplaces.local();
    for (int plane = 0; plane < planes; ++plane) {
      take_rows(stack.slices[plane], b * band_rows, work.plane);
      work.slices.take(plane, work.plane);
    }
    composite_band(work.slices, compositing, tone, b * band_rows);
  });
}

}  // namespace

SliceHiding hiding_of(const SliceStack& stack) {
  if (stack.hiding) return *stack.hiding;
  SliceHiding hiding = SliceHiding::nothing;
  for (const Slice& slice : stack.slices)
    for (const LinearRgba& pixel : slice.pixels.pixels()) {
      if (pixel.a > 0 && pixel.a < 1) return SliceHiding::softly;
      if (pixel.a > 0) hiding = SliceHiding::sharply;
    }
  return hiding;
}

std::vector<Image<Rgb8>> render_slices(const SliceStack& stack, const Rig& rig, SliceFilter filter,
                                       const Progress& progress, const std::optional<Focus>& focus) {
  check_views_fit(rig);
  std::vector<Image<Rgb8>> views(rig.positions.size(), Image<Rgb8>(rig.width, rig.height));
  std::vector<ViewTarget> targets;
  for (Image<Rgb8>& view : views) targets.push_back({.picture = view});
  composite_stack(stack, rig.positions, filter, focus,
                  [&](const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top) {
                    composite(slices, compositing, tone, top, targets);
                  });
  report(progress, "views", 1);
  return views;
}

InterleavedView render_interleaved(const SliceStack& stack, std::span<const ViewPosition> views,
                                   const ViewsOfRow& views_of_row, const Progress& progress,
                                   const std::optional<Focus>& focus) {
  InterleavedView result{.picture = Image<Rgb8>(stack.width, stack.height), .composited = 0};
  composite_stack(stack, views, SliceFilter::linear, focus,
                  [&](const SliceBand& slices, const Compositing& compositing, const ToneMap& tone, int top) {
                    composite(slices, compositing, tone, top, {result.picture, views_of_row});
                  });
  result.composited = 3 * static_cast<std::uint64_t>(stack.width) * stack.height;
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

void map_depth(SliceStack& stack, std::span<const DepthRegion> regions, ViewingGeometry viewing) {
  if (stack.slices.empty()) return;
  viewing.width_px = stack.width;
  const DepthEnds ends{-stack.slices.back().parallax_px, -stack.slices.front().parallax_px};
  const DisparityMapping mapping = disparity_mapping(regions, ends, viewing);
  for (Slice& slice : stack.slices) slice.parallax_px = -mapped_px(mapping, -slice.parallax_px);
}

}  // namespace wheatstone
