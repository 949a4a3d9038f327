#include "wheatstone/multiview/gpu_finish_internal.h"

#include <bit>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

#include "composite_planes_source.h"
#include "finish_views_source.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/gpu/program.h"

namespace wheatstone {
namespace {

/// Parameters of finish_views.comp: numbers of four bytes, without gaps.
struct FinishWork {
  std::int32_t channels = 0, width = 0, rows = 0, pad = 0;
  std::int32_t base = 0;
  std::int32_t smaller_width = 0, smaller_rows = 0;
  std::int32_t shows_mean = 0;
  std::int32_t hues = 0, table_size = 0, stretch_size = 0, first_index = 0;
  float exposure = 0, scale = 0, offset = 0;
};

/// Parameters of composite_planes.comp for packing.
struct PackWork {
  std::int32_t width = 0, rows = 0;
  std::int32_t texels_a_row = 0;
  std::int32_t first_value = 0, first_texel = 0;
};

/// Parameters of composite_planes.comp for moving planes.
struct CompositeWork {
  std::int32_t width = 0, rows = 0;
  std::int32_t left = 0, texels_a_row = 0;
  std::int32_t first_plane = 0, end_plane = 0, base = 0;
  std::int32_t taps = 1;
  std::int32_t again = 0;
  float first_parallax = 0, plane_spacing = 1;
  float focus_x = 0, focus_y = 0, focus_radius = 1, focus_gain = 1;
  float unused = 0;
  std::array<std::array<float, 4>, most_gpu_views> views{};
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

/// What becomes of a picture's light, as finish_views.comp numbers it.
int shown_as(const ToneMap& tone, std::size_t picture) {
  constexpr int stays_light = 0, as_look = 1, as_mass = 2, as_colours = 3;
  if (picture > 0) return stays_light;
  if (tone.look == Look::thesis) return as_look;
  return tone.shown == Shown::colours ? as_colours : as_mass;
}

/// Steps of composite_planes.comp.
constexpr int packs = 0, moves = 1, moves_in_focus = 2;

FinishWork finish_work(const GpuPictures& pictures, const ToneMap& tone, std::size_t picture, int base) {
  FinishWork work{.channels = pictures.channels,
                  .width = pictures.width[picture],
                  .rows = pictures.orders[picture].rows,
                  .pad = pictures.orders[picture].pad,
                  .base = base,
                  .shows_mean = tone.shown == Shown::mean,
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

/// Four words, which hold two pixels.
constexpr std::size_t texel_bytes = 16;

int texels_a_row(const GpuPictures& planes, std::size_t picture) { return (planes.width[picture] + 1) / 2; }

/// Packs the planes of a picture that are in a group.
void pack(const GpuPictures& planes, const TargetGroup& group, std::size_t picture, int first_texel,
          const GpuBuffer& light, const GpuBuffer& packed) {
  const int count = group.end[picture] - group.first[picture];
  if (count == 0) return;
  PackWork work{.width = planes.width[picture],
                .rows = planes.orders[picture].rows,
                .texels_a_row = texels_a_row(planes, picture)};
  work.first_value = group.base[picture] + group.first[picture] * static_cast<int>(planes.values(picture));
  work.first_texel = first_texel + group.first[picture] * work.texels_a_row * work.rows;
  const GpuBuffer of_work(std::span<const PackWork>(&work, 1));
  kept_program(composite_planes_source, {{"STEP", packs}, {"CHANNELS", planes.channels}})
      .run({groups_of(work.texels_a_row, 64), static_cast<std::uint32_t>(work.rows), static_cast<std::uint32_t>(count)},
           {&of_work, &light, &packed});
}

}  // namespace

void finish_on_gpu(const GpuPictures& pictures, const ToneMap& tone,
                   const std::function<GpuLight(std::size_t)>& light_of, std::span<const ImageView<Rgb8>> views) {
  const std::vector<std::int32_t> all_tables = tables_of(tone);
  const GpuBuffer tables{std::span<const std::int32_t>(all_tables)};
  const GpuBuffer none(0);
  const GpuBuffer colours = GpuBuffer::of_any_bytes(pictures.pixels(0) * views.size() * sizeof(std::uint32_t));
  std::vector<GpuBuffer> finished;  // light of the pictures, the smallest first
  for (std::size_t p = pictures.size(); p-- > 0;) {
    const GpuLight own = light_of(p);
    const FinishWork work = finish_work(pictures, tone, p, own.base);
    const GpuBuffer of_work(std::span<const FinishWork>(&work, 1));
    const std::size_t bytes = pictures.values(p) * views.size() * sizeof(float);
    GpuBuffer here = GpuBuffer::of_any_bytes(p > 0 ? bytes : 0);
    const auto [columns, rows, count] = groups_of_pixels(pictures, p, views.size());
    kept_program(finish_views_source, {{"SHOWN", shown_as(tone, p)}})
        .run({columns, rows, count},
             {&of_work, own.light, finished.empty() ? &none : &finished.back(), p > 0 ? &here : &colours, &tables});
    finished.push_back(std::move(here));
  }
  std::vector<std::uint32_t> pixels(pictures.pixels(0) * views.size());
  colours.read(std::span(pixels));
  for_each_view(views.size(), [&](std::size_t v) {
    unpack(std::span(pixels).subspan(v * pictures.pixels(0), pictures.pixels(0)), views[v]);
  });
}

GpuCompositor::GpuCompositor(const GpuPictures& planes, LightOnGpu light, SliceFilter filter,
                             std::optional<Focus> focus)
    : planes_(planes), groups_(std::move(light.groups)), filter_(filter), focus_(focus) {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    std::vector<int>& first_texel = first_texel_.emplace_back();
    int texels = 0;
    for (std::size_t p = 0; p < planes.size(); ++p) {
      const int a_plane = texels_a_row(planes, p) * planes.orders[p].rows;
      first_texel.push_back(texels - groups_[g].first[p] * a_plane);
      texels += (groups_[g].end[p] - groups_[g].first[p]) * a_plane;
    }
    packed_.push_back(GpuBuffer::of_any_bytes(static_cast<std::size_t>(texels) * texel_bytes));
    for (std::size_t p = 0; p < planes.size(); ++p)
      pack(planes, groups_[g], p, first_texel[p], light.light[g], packed_[g]);
  }
}

const GpuProgram& GpuCompositor::program() const {
  const GpuDefine channels{"CHANNELS", planes_.channels};
  if (focus_) return kept_program(composite_planes_source, {{"STEP", moves_in_focus}, channels});
  return kept_program(composite_planes_source, {{"STEP", moves}, channels, {"TAPS", taps_of(filter_) > 2 ? 4 : 2}});
}

GpuBuffer GpuCompositor::composite(std::size_t picture, const GpuPictures& of_views,
                                   std::span<const ViewPosition> views) const {
  const SplatOrder& order = planes_.orders[picture];
  GpuBuffer composited = GpuBuffer::of_any_bytes(of_views.values(picture) * views.size() * sizeof(float));
  CompositeWork work{.width = of_views.width[picture],
                     .rows = order.rows,
                     .left = planes_.left[picture],
                     .texels_a_row = texels_a_row(planes_, picture),
                     .taps = taps_of(filter_),
                     .first_parallax = order.first * order.scale,
                     .plane_spacing = order.spacing};
  if (const std::optional<Focus> focus = focus_in(focus_, order)) {
    work.focus_x = focus->x_px;
    work.focus_y = focus->y_px;
    work.focus_radius = focus->radius_px;
    work.focus_gain = focus->gain;
  }
  for (std::size_t v = 0; v < views.size(); ++v) work.views[v][0] = views[v] - central_view;
  const std::uint32_t rows = focus_ ? static_cast<std::uint32_t>(work.rows) : groups_of(work.rows, 8);
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    work.first_plane = groups_[g].first[picture];
    work.end_plane = groups_[g].end[picture];
    work.base = first_texel_[g][picture];
    if (work.first_plane == work.end_plane) continue;
    const GpuBuffer of_work(std::span<const CompositeWork>(&work, 1));
    program().run({groups_of(work.width, 64), rows, static_cast<std::uint32_t>(views.size())}, {&of_work, &composited},
                  {&packed_[g]});
    work.again = 1;
  }
  return composited;
}

}  // namespace wheatstone
