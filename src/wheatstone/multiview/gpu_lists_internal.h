#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/gpu/views.h"
#include "wheatstone/multiview/gpu_splats_internal.h"

namespace wheatstone {

/// Kinds of splats, as splat_kinds.glsl numbers them: by picture, brightness and width.
constexpr int splat_widths = 3, splat_brightnesses = 7;
constexpr int kinds_a_picture = splat_widths * splat_brightnesses;
constexpr int most_kinds = PictureTable::most * kinds_a_picture;

/// As many particles as are gathered at a time.
constexpr std::size_t most_gathered = 1 << 20;

/// What the programs that put splats into lists and gather them read of their work (splat_lists.glsl): numbers of four
/// bytes, without gaps.
struct ListWork {
  std::int32_t splats = 0;
  GpuTargets targets = GpuTargets::views;
  std::int32_t by_mass = 0;
  std::int32_t picture = 0, first_target = 0, end_target = 0, base = 0;
  std::int32_t channels = 0, first_kind = 0, end_kind = 0;
  GpuWritten written = GpuWritten::sums;
  std::array<std::int32_t, most_kinds> index_of{}, first_list{}, brightness{};
  std::array<float, most_kinds> reach{};
  std::array<std::int32_t, PictureTable::most> rows{}, bands{}, lists_a_band{}, slabs{}, left{}, width{};
  std::array<float, PictureTable::most> lists_left{}, first_parallax{}, slab_parallax{};
  std::array<float, most_gpu_views> view{};
};

/// Adds splats to sums in fixed point, of 64 bits and with steps of 2^−28. Projected splats are sorted into lists once
/// for all targets; then each invocation of a program owns a few pixels of one target, and gathers the lists that reach
/// there. Made and used within on_gpu().
class SplatGatherer {
 public:
  SplatGatherer(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures, GpuTargets targets,
                std::span<const ViewPosition> views, std::span<const TargetGroup> groups);
  /// Where project_splats.comp writes: splats, and how far the widest of each kind reaches.
  const GpuBuffer& splats() const { return splats_; }
  const GpuBuffer& reaches() const { return reaches_; }
  /// Adds so many that were projected, or makes light of them where they are all there is. False where their lists do
  /// not fit into a buffer.
  bool add(std::size_t count, bool all);
  /// The sums or the light of each group.
  std::vector<GpuBuffer> gathered() && { return std::move(sums_); }

 private:
  std::size_t number_lists();
  void gather(const GpuBuffer& ends, const GpuBuffer& entries, bool all);

  const GpuPictures& pictures_;
  std::span<const TargetGroup> groups_;
  bool by_mass_, opaque_;
  ListWork work_;
  std::size_t most_entries_;
  GpuBuffer splats_, reaches_;
  std::vector<GpuBuffer> sums_;
  std::vector<std::vector<char>> begun_;  // [group][picture]
};

}  // namespace wheatstone
