#include "wheatstone/multiview/gpu_lists_internal.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include "begin_lists_source.h"
#include "gather_splats_source.h"
#include "place_splats_source.h"
#include "wheatstone/gpu/program.h"
#include "wheatstone/multiview/gathered_light_internal.h"

namespace wheatstone {
namespace {

// As splat_lists.glsl and gather_splats.comp have them.
constexpr int list_rows = 2, list_columns = 2, gathered_columns = 4, group_side = 8;
constexpr std::size_t entry_bytes = 32;
/// Mesa's llvmpipe 22 ends the loops of an invocation after 65535 iterations in all.
constexpr std::size_t most_iterations = 65000;
/// Kinds whose reaches differ by no more are gone through together.
constexpr float joined_px = 2;
/// For splats less bright than this, all steps of sums are counted (most_rest_bits of gather_splats.comp).
constexpr int all_counted_below = 4;
/// Views move splats by this many pixels, beside those that a list has, before lists are cut by parallax.
constexpr float moved_px = 6;

/// Replaces the number of entries of each list by the index at which the list begins. Returns the number of all
/// entries.
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
  kept_program(begin_lists_source, {{"STEP", 0}}).run({groups_of(groups, 64)}, {&lists, &sums});
  const std::uint32_t all = begin_lists(sums);
  kept_program(begin_lists_source, {{"STEP", 1}}).run({groups_of(groups, 64)}, {&lists, &sums});
  return all;
}

void set_pictures(const RenderJob& job, const GpuPictures& pictures, GpuTargets targets, ListWork& work) {
  const Window window = window_of_planes(job);
  const auto parallax = [](const DepthMapping::Point& point) { return point.parallax_px; };
  const auto [nearest, farthest] = std::ranges::minmax(job.scene.mapping.points, {}, parallax);
  const float range = farthest.parallax_px - nearest.parallax_px;
  float farthest_view = 0;
  for (const auto& view : work.views) farthest_view = std::max(farthest_view, std::abs(view[0]));
  for (std::size_t p = 0; p < pictures.size(); ++p) {
    const SplatOrder& order = pictures.orders[p];
    const Window here = window_in(window, order);
    ListWork::Picture& picture = work.pictures[p];
    picture.rows = order.rows;
    picture.bands = (order.rows + list_rows - 1) / list_rows;
    picture.lists_left = here.left;
    picture.lists_a_band = static_cast<int>((here.right - here.left) / list_columns) + 1;
    picture.left = pictures.left[p];
    picture.width = pictures.width[p];
    if (targets == GpuTargets::views || targets == GpuTargets::discs_in_views) {
      picture.slabs = std::max(static_cast<int>(std::lround(range * order.scale * farthest_view / moved_px)), 1);
      picture.first_parallax = nearest.parallax_px * order.scale;
      picture.slab_parallax = std::max(range * order.scale / static_cast<float>(picture.slabs), 1e-6f);
    } else {
      picture.slabs = order.parts;
      picture.first_parallax = order.first * order.scale;
      picture.slab_parallax = order.spacing;
    }
  }
}

std::size_t bytes_a_value(GpuWritten written) { return written == GpuWritten::light ? sizeof(float) : sum_bytes; }

}  // namespace

SplatGatherer::SplatGatherer(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures,
                             GpuTargets targets, std::span<const ViewPosition> views,
                             std::span<const TargetGroup> groups, GpuWritten written)
    : pictures_(pictures),
      groups_(groups),
      kernel_{spread_of(deposit_of(job.scene.splat_style), targets == GpuTargets::discs_in_views)},
      most_entries_(std::min(facts.largest_buffer / entry_bytes, facts.most_texels / 2)),
      most_by_one_(facts.imitated ? most_iterations * kernel_.entries_at_once() : most_entries_),
      splats_(GpuBuffer::of_any_bytes(most_gathered * entry_bytes)),
      reaches_(most_kinds * sizeof(float)) {
  work_.targets = targets == GpuTargets::discs_in_views ? GpuTargets::views : targets;
  work_.channels = pictures.channels;
  for (std::size_t v = 0; v < views.size(); ++v) work_.views[v][0] = views[v] - central_view;
  set_pictures(job, pictures, targets, work_);
  work_.written = written;
  const bool adds = written == GpuWritten::more_sums;
  for (const TargetGroup& group : groups) {
    const std::size_t bytes = group.values * bytes_a_value(written);
    sums_.push_back(adds ? GpuBuffer(bytes) : GpuBuffer::of_any_bytes(bytes));
  }
  begun_.assign(groups.size(), std::vector<char>(pictures.size(), adds ? 1 : 0));
}

/// Numbers the kinds that are there, and their lists. Returns how many lists these are.
std::size_t SplatGatherer::number_lists() {
  std::array<float, most_kinds> reaches{};
  reaches_.read(std::span<float>(reaches));
  next_kind_ = next_list_ = 0;
  for (std::size_t p = 0; p < pictures_.size(); ++p) {
    work_.pictures[p].first_kind = next_kind_;
    const auto first = static_cast<int>(p) * kinds_a_picture;
    for (int brightness = splat_brightnesses - 1; brightness >= 0; --brightness) {
      // Fractions of a step are counted, too, so that fainter splats can be counted in the same steps.
      const bool joins = kernel_.counts_rest() && brightness < all_counted_below;
      const int least = joins ? 0 : brightness;
      number_kinds(static_cast<int>(p),
                   std::span(reaches).subspan(first + least * splat_widths, (brightness + 1 - least) * splat_widths),
                   first + least * splat_widths);
      brightness = least;
    }
    work_.pictures[p].end_kind = next_kind_;
  }
  return static_cast<std::size_t>(next_list_);
}

/// Numbers kinds that are counted in the same steps: those that reach about as far have the same number.
void SplatGatherer::number_kinds(int picture, std::span<const float> reaches, int first_kind) {
  const auto last_there = std::ranges::find_if(reaches.rbegin(), reaches.rend(), [](float reach) { return reach > 0; });
  if (last_there == reaches.rend()) {
    for (std::size_t i = 0; i < reaches.size(); ++i) work_.kinds[first_kind + i].index = -1;
    return;
  }
  const auto brightest = first_kind + static_cast<int>(reaches.rend() - last_there) - 1;
  std::vector<int> widest_first(reaches.size());
  std::iota(widest_first.begin(), widest_first.end(), 0);
  std::ranges::stable_sort(widest_first, std::greater(), [&](int i) { return reaches[i]; });
  float reach = std::numeric_limits<float>::infinity();
  for (const int i : widest_first) {
    work_.kinds[first_kind + i].index = reaches[i] > 0 ? next_kind_ - 1 : -1;
    if (reaches[i] == 0 || reach - reaches[i] <= joined_px) continue;
    reach = reaches[i];
    const ListWork::Picture& of = work_.pictures[picture];
    ListWork::Kind& numbered = work_.kinds[next_kind_];
    numbered.first_list = next_list_;
    numbered.brightness = brightest % kinds_a_picture / splat_widths;
    numbered.reach = reach;
    work_.kinds[first_kind + i].index = next_kind_;
    next_list_ += of.slabs * of.bands * of.lists_a_band;
    ++next_kind_;
  }
}

/// The largest number of entries that one invocation may go through: those of a band, of all kinds and, if views
/// gather, of all slabs.
std::size_t SplatGatherer::most_in_a_band(const GpuBuffer& begins, std::size_t in_lists) const {
  std::vector<std::uint32_t> begin(begins.bytes() / sizeof(std::uint32_t));
  begins.read(std::span(begin));
  begin.push_back(static_cast<std::uint32_t>(in_lists));
  const bool together = work_.targets == GpuTargets::views;
  std::array<std::vector<std::size_t>, PictureTable::most> entries;
  for (std::size_t p = 0; p < pictures_.size(); ++p) {
    const ListWork::Picture& picture = work_.pictures[p];
    entries[p].resize(static_cast<std::size_t>(picture.bands) * (together ? 1 : picture.slabs));
    for (int kind = picture.first_kind; kind < picture.end_kind; ++kind) {
      std::size_t list = work_.kinds[kind].first_list;
      for (int i = 0; i < picture.slabs * picture.bands; ++i, list += picture.lists_a_band)
        entries[p][i % entries[p].size()] += begin[list + picture.lists_a_band] - begin[list];
    }
  }
  std::size_t most = 0;
  for (const std::vector<std::size_t>& of_picture : entries)
    for (const std::size_t count : of_picture) most = std::max(most, count);
  return most;
}

bool SplatGatherer::add(std::size_t count, std::optional<int> target) {
  const std::size_t lists = number_lists();
  reaches_.clear();
  if (lists == 0) return true;
  work_.splats = static_cast<std::int32_t>(count);
  const GpuBuffer of_work(std::span<const ListWork>(&work_, 1));
  GpuBuffer ends((lists + 3) / 4 * 4 * sizeof(std::uint32_t));
  kept_program(place_splats_source, {{"STEP", 0}}).run({groups_of(count, 64)}, {&of_work, &ends}, {&splats_});
  const std::size_t in_lists = begin_lists(ends);
  if (in_lists > most_entries_ && count > 1) return false;
  if (in_lists > most_by_one_ && count > 1 && most_in_a_band(ends, in_lists) > most_by_one_) return false;
  const GpuBuffer entries = GpuBuffer::of_any_bytes((in_lists + 1) * entry_bytes);
  kept_program(place_splats_source, {{"STEP", 1}, {"CHANNELS", work_.channels}, {"KERNEL", kernel_.spread}})
      .run({groups_of(count, 64)}, {&of_work, &ends, &entries}, {&splats_});
  gather(ends, entries, target);
  return true;
}

void SplatGatherer::gather(const GpuBuffer& ends, const GpuBuffer& entries, std::optional<int> target) {
  const GpuWritten written = work_.written;
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      const int kinds = work_.pictures[p].end_kind - work_.pictures[p].first_kind;
      const int first = target ? std::max(*target, groups_[g].first[p]) : groups_[g].first[p];
      const int targets = (target ? std::min(*target + 1, groups_[g].end[p]) : groups_[g].end[p]) - first;
      if (kinds == 0 || targets <= 0) continue;
      work_.picture = static_cast<std::int32_t>(p);
      work_.first_target = first;
      work_.end_target = first + targets;
      work_.base = groups_[g].base[p];
      work_.written = written == GpuWritten::sums && begun_[g][p] != 0 ? GpuWritten::more_sums : written;
      begun_[g][p] = 1;
      const GpuBuffer of_work(std::span<const ListWork>(&work_, 1));
      const ListWork::Picture& picture = work_.pictures[p];
      kept_program(gather_splats_source, {{"CHANNELS", work_.channels}, {"KERNEL", kernel_.spread}})
          .run({groups_of(picture.width, gathered_columns * group_side), groups_of(picture.bands, group_side),
                static_cast<std::uint32_t>(targets)},
               {&of_work, &ends, &sums_[g]}, {&entries, &ends});
    }
  work_.written = written;
}

std::vector<GpuBuffer> SplatGatherer::gathered() && {
  const std::size_t bytes = bytes_a_value(work_.written);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (std::size_t p = 0; p < pictures_.size(); ++p) {
      const std::size_t values = pictures_.values(p);
      const int targets = groups_[g].end[p] - groups_[g].first[p];
      if (begun_[g][p] != 0 || targets == 0) continue;
      const std::size_t first = groups_[g].base[p] + groups_[g].first[p] * values;
      sums_[g].clear(first * bytes, targets * values * bytes);
    }
  return std::move(sums_);
}

}  // namespace wheatstone
