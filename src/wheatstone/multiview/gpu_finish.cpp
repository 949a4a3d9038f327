#include "wheatstone/multiview/gpu_finish_internal.h"

#include <bit>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "composite_planes_source.h"
#include "finish_views_source.h"
#include "wheatstone/gpu/program.h"

namespace wheatstone {
namespace {

/// What finish_views.comp reads of its work: numbers of four bytes, without gaps.
struct FinishWork {
  std::int32_t channels = 0, width = 0, rows = 0, pad = 0;
  std::int32_t base = 0;
  std::int32_t smaller_width = 0, smaller_rows = 0;
  std::int32_t shown = 0;
  std::int32_t hues = 0, table_size = 0, stretch_size = 0, first_index = 0;
  float exposure = 0, scale = 0, offset = 0;
};

/// What composite_planes.comp reads of its work.
struct CompositeWork {
  std::int32_t channels = 0, width = 0, rows = 0;
  std::int32_t left = 0, plane_width = 0;
  std::int32_t first_plane = 0, end_plane = 0, base = 0;
  std::int32_t taps = 1;
  float first_parallax = 0, plane_spacing = 1;
  std::array<float, most_gpu_views> view{};
};

/// The tables of the tone map, one after the other, as finish_views.comp reads them.
std::vector<std::int32_t> tables_of(const ToneMap& tone) {
  std::vector<std::int32_t> tables = tone.table;
  tables.insert(tables.end(), tone.stretch.begin(), tone.stretch.end());
  std::ranges::transform(tone.linear_stretch, std::back_inserter(tables),
                         [](float value) { return std::bit_cast<std::int32_t>(value); });
  tables.insert(tables.end(), tone.colours.begin(), tone.colours.end());
  return tables;
}

/// How the shader shows sums; 0 leaves them light.
std::int32_t shown_as(const ToneMap& tone) {
  if (tone.look == Look::thesis) return 1;
  if (tone.shown == Shown::colours) return 4;
  return tone.shown == Shown::mean ? 3 : 2;
}

FinishWork finish_work(const GpuPictures& pictures, const ToneMap& tone, std::size_t picture, int base) {
  FinishWork work{.channels = pictures.channels,
                  .width = pictures.width[picture],
                  .rows = pictures.orders[picture].rows,
                  .pad = pictures.orders[picture].pad,
                  .base = base,
                  .shown = picture == 0 ? shown_as(tone) : 0,
                  .hues = tone.hues,
                  .table_size = ToneMap::table_size,
                  .stretch_size = ToneMap::stretch_size,
                  .first_index = ToneMap::first_index,
                  .exposure = tone.exposure,
                  .scale = tone.scale,
                  .offset = tone.offset};
  if (picture + 1 < pictures.size()) {
    work.smaller_width = pictures.width[picture + 1];
    work.smaller_rows = pictures.orders[picture + 1].rows;
  }
  return work;
}

/// Groups of invocations for every pixel of a picture in every view.
std::array<std::uint32_t, 3> groups_of_pixels(const GpuPictures& pictures, std::size_t picture, std::size_t views) {
  return {groups_of(pictures.width[picture], 64), static_cast<std::uint32_t>(pictures.orders[picture].rows),
          static_cast<std::uint32_t>(views)};
}

}  // namespace

void finish_on_gpu(const GpuPictures& pictures, const ToneMap& tone,
                   const std::function<GpuLight(std::size_t)>& light_of, std::span<const ImageView<Rgb8>> views) {
  const GpuProgram finish_views(finish_views_source);
  const std::vector<std::int32_t> all_tables = tables_of(tone);
  const GpuBuffer tables{std::span<const std::int32_t>(all_tables)};
  const GpuBuffer none(0);
  const GpuBuffer colours(pictures.pixels(0) * views.size() * sizeof(std::uint32_t));
  std::vector<GpuBuffer> finished;  // light of the pictures, the smallest first
  for (std::size_t p = pictures.size(); p-- > 0;) {
    const GpuLight own = light_of(p);
    const FinishWork work = finish_work(pictures, tone, p, own.base);
    const GpuBuffer of_work(std::span<const FinishWork>(&work, 1));
    GpuBuffer here(p > 0 ? pictures.values(p) * views.size() * sizeof(float) : 0);
    const auto [columns, rows, count] = groups_of_pixels(pictures, p, views.size());
    finish_views.run({columns, rows, count},
                     {&of_work, own.light, finished.empty() ? &none : &finished.back(), &here, &colours, &tables});
    finished.push_back(std::move(here));
  }
  std::vector<std::uint32_t> pixels(pictures.pixels(0) * views.size());
  colours.read(std::span(pixels));
  for (std::size_t v = 0; v < views.size(); ++v)
    unpack(std::span(pixels).subspan(v * pictures.pixels(0), pictures.pixels(0)), views[v]);
}

GpuCompositor::GpuCompositor(const GpuPictures& planes, std::span<const TargetGroup> groups,
                             std::span<const GpuBuffer> light, Resampling resampling)
    : planes_(planes), groups_(groups), light_(light), resampling_(resampling), program_(composite_planes_source) {}

GpuBuffer GpuCompositor::composite(std::size_t picture, const GpuPictures& of_views,
                                   std::span<const ViewPosition> views) const {
  const SplatOrder& order = planes_.orders[picture];
  GpuBuffer composited(of_views.values(picture) * views.size() * sizeof(float));
  const auto [columns, rows, count] = groups_of_pixels(of_views, picture, views.size());
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const CompositeWork work{.channels = planes_.channels,
                             .width = of_views.width[picture],
                             .rows = order.rows,
                             .left = planes_.left[picture],
                             .plane_width = planes_.width[picture],
                             .first_plane = groups_[g].first[picture],
                             .end_plane = groups_[g].end[picture],
                             .base = groups_[g].base[picture],
                             .taps = taps_of(resampling_),
                             .first_parallax = order.first * order.scale,
                             .plane_spacing = order.spacing,
                             .view = gpu_views(views)};
    if (work.first_plane == work.end_plane) continue;
    const GpuBuffer of_work(std::span<const CompositeWork>(&work, 1));
    program_.run({columns, rows, count}, {&of_work, &light_[g], &composited});
  }
  return composited;
}

}  // namespace wheatstone
