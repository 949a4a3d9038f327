#include "wheatstone/multiview/gpu_lists_internal.h"

#include <algorithm>
#include <cmath>

#include "begin_lists_source.h"
#include "count_splats_source.h"
#include "gather_colours_source.h"
#include "gather_light_source.h"
#include "gather_mass_source.h"
#include "gather_opaque_source.h"
#include "place_opaque_source.h"
#include "place_splats_source.h"
#include "sum_lists_source.h"
#include "wheatstone/gpu/program.h"
#include "wheatstone/multiview/gathered_light_internal.h"

namespace wheatstone {
namespace {

// As splat_lists.glsl and gather_splats.glsl have them.
constexpr int band_rows = 2, list_columns = 4, gathered_columns = 8, group_side = 8;
constexpr std::size_t entry_bytes = 32;
/// Views move splats by this many pixels, beside those that a list has, before lists are cut by parallax.
constexpr float moved_px = 6;

/// Of lists, how many entries each has becomes where it begins. Returns how many there are in all.
std::uint32_t begin_lists(GpuBuffer& lists) {
  const std::size_t count = lists.bytes() / sizeof(std::uint32_t);
  if (count == 1) {
    std::uint32_t all = 0;
    lists.read(std::span(&all, 1));
    lists.clear();
    return all;
  }
  const std::uint32_t groups = groups_of(count, 64);
  GpuBuffer sums(groups * sizeof(std::uint32_t));
  kept_program(sum_lists_source).run({groups_of(groups, 64)}, {&lists, &sums});
  const std::uint32_t all = begin_lists(sums);
  kept_program(begin_lists_source).run({groups_of(groups, 64)}, {&lists, &sums});
  return all;
}

void set_pictures(const RenderJob& job, const GpuPictures& pictures, GpuTargets targets, ListWork& work) {
  const Window window = window_around(job.scene, job.rig);
  const auto parallax = [](const DepthMapping::Point& point) { return point.parallax_px; };
  const auto [nearest, farthest] = std::ranges::minmax(job.scene.mapping.points, {}, parallax);
  const float range = farthest.parallax_px - nearest.parallax_px;
  float farthest_view = 0;
  for (const float view : work.view) farthest_view = std::max(farthest_view, std::abs(view));
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    const SplatOrder& order = pictures.orders[p];
    const Window here = window_in(window, order);
    work.rows[p] = order.rows;
    work.bands[p] = (order.rows + band_rows - 1) / band_rows;
    work.lists_left[p] = here.left;
    work.lists_a_band[p] = static_cast<int>((here.right - here.left) / list_columns) + 1;
    work.left[p] = pictures.left[p];
    work.width[p] = pictures.width[p];
    if (targets == GpuTargets::views || targets == GpuTargets::discs_in_views) {
      work.slabs[p] = std::max(static_cast<int>(std::lround(range * order.scale * farthest_view / moved_px)), 1);
      work.first_parallax[p] = nearest.parallax_px * order.scale;
      work.slab_parallax[p] = std::max(range * order.scale / static_cast<float>(work.slabs[p]), 1e-6f);
    } else {
      work.slabs[p] = order.parts;
      work.first_parallax[p] = order.first * order.scale;
      work.slab_parallax[p] = order.spacing;
    }
  }
}

}  // namespace

SplatGatherer::SplatGatherer(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures,
                             GpuTargets targets, std::span<const ViewPosition> views,
                             std::span<const TargetGroup> groups)
    : pictures_(pictures),
      groups_(groups),
      by_mass_(job.scene.splat_style.look == Look::mass),
      opaque_(targets == GpuTargets::discs_in_views),
      most_entries_(std::min(facts.largest_buffer / entry_bytes, facts.most_texels / 2)),
      splats_(GpuBuffer::of_any_bytes(most_gathered * entry_bytes)),
      reaches_(most_kinds * sizeof(float)) {
  work_.targets = opaque_ ? GpuTargets::views : targets;
  work_.by_mass = by_mass_;
  work_.channels = pictures.channels;
  work_.view = gpu_views(views);
  set_pictures(job, pictures, targets, work_);
  for (const TargetGroup& group : groups) sums_.emplace_back(group.values * sum_bytes);
  begun_.assign(groups.size(), std::vector<char>(pictures.size()));
}

/// Numbers the kinds that are there, and their lists. Returns how many lists these are.
std::size_t SplatGatherer::number_lists() {
  std::array<float, most_kinds> reaches{};
  reaches_.read(std::span<float>(reaches));
  int kinds = 0;
  int lists = 0;
  for (int kind = 0; kind < most_kinds; ++kind) {
    work_.index_of[kind] = -1;
    if (reaches[kind] == 0) continue;
    const int picture = kind / kinds_a_picture;
    work_.index_of[kind] = kinds;
    work_.first_list[kinds] = lists;
    work_.brightness[kinds] = kind % kinds_a_picture / splat_widths;
    work_.reach[kinds] = reaches[kind];
    lists += work_.slabs[picture] * work_.bands[picture] * work_.lists_a_band[picture];
    ++kinds;
  }
  return static_cast<std::size_t>(lists);
}

bool SplatGatherer::add(std::size_t count, bool all) {
  const std::size_t lists = number_lists();
  reaches_.clear();
  if (lists == 0) return true;
  work_.splats = static_cast<std::int32_t>(count);
  const GpuBuffer of_work(std::span<const ListWork>(&work_, 1));
  GpuBuffer ends(lists * sizeof(std::uint32_t));
  kept_program(count_splats_source).run({groups_of(count, 64)}, {&of_work, &ends}, {&splats_});
  const std::size_t in_lists = begin_lists(ends);
  if (in_lists > most_entries_ && count > 1) return false;
  const GpuBuffer entries = GpuBuffer::of_any_bytes((in_lists + 1) * entry_bytes);
  kept_program(opaque_ ? place_opaque_source : place_splats_source)
      .run({groups_of(count, 64)}, {&of_work, &ends, &entries}, {&splats_});
  gather(ends, entries, all);
  return true;
}

void SplatGatherer::gather(const GpuBuffer& ends, const GpuBuffer& entries, bool all) {
  const GpuSource& of_mass = work_.channels == 3 ? gather_colours_source : gather_mass_source;
  const GpuSource& source = opaque_ ? gather_opaque_source : by_mass_ ? of_mass : gather_light_source;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      const auto here = std::span(work_.index_of).subspan(p * kinds_a_picture, kinds_a_picture);
      const auto kinds = static_cast<int>(std::ranges::count_if(here, [](int index) { return index >= 0; }));
      const int targets = groups_[g].end[p] - groups_[g].first[p];
      if (kinds == 0 || targets == 0) continue;
      work_.first_kind = *std::ranges::find_if(here, [](int index) { return index >= 0; });
      work_.end_kind = work_.first_kind + kinds;
      work_.picture = static_cast<std::int32_t>(p);
      work_.first_target = groups_[g].first[p];
      work_.end_target = groups_[g].end[p];
      work_.base = groups_[g].base[p];
      work_.written = all ? GpuWritten::light : begun_[g][p] != 0 ? GpuWritten::more_sums : GpuWritten::sums;
      begun_[g][p] = 1;
      const GpuBuffer of_work(std::span<const ListWork>(&work_, 1));
      kept_program(source).run({groups_of(work_.width[p], gathered_columns * group_side),
                                groups_of(work_.bands[p], group_side), static_cast<std::uint32_t>(targets)},
                               {&of_work, &ends, &sums_[g]}, {&entries});
    }
}

}  // namespace wheatstone
