#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/gpu/program.h"
#include "wheatstone/gpu/views.h"
#include "wheatstone/multiview/gpu_splats_internal.h"

namespace wheatstone {

/// Kinds of splats, as splat_kinds.glsl numbers them: by picture, brightness and width.
constexpr int splat_widths = 3, splat_brightnesses = 8;
constexpr int kinds_a_picture = splat_widths * splat_brightnesses;
constexpr int most_kinds = PictureTable::most * kinds_a_picture;

/// As many particles as are gathered at a time.
constexpr std::size_t most_gathered = 1 << 20;

/// The parameters of the programs that put splats into lists and gather them (splat_lists.glsl): numbers of four bytes,
/// without gaps.
struct ListWork {
  std::int32_t splats = 0;
  GpuTargets targets = GpuTargets::views;
  std::int32_t picture = 0, first_target = 0, end_target = 0, base = 0;
  std::int32_t channels = 0;
  GpuWritten written = GpuWritten::sums;
  /// `index`: compact number of the kind, -1 if no splat has it; the other fields are indexed by that number.
  struct Kind {
    std::int32_t index = 0, first_list = 0, brightness = 0;
    float reach = 0;
  };
  struct Picture {
    std::int32_t rows = 0, bands = 0, lists_a_band = 0, slabs = 0;
    std::int32_t left = 0, width = 0;
    float lists_left = 0, first_parallax = 0;
    float slab_parallax = 0;
    std::int32_t first_kind = 0, end_kind = 0;  ///< numbers of the kinds that are there
    std::int32_t unused = 0;
  };
  std::array<Kind, most_kinds> kinds{};
  std::array<Picture, PictureTable::most> pictures{};
  std::array<std::array<float, 4>, most_gpu_views> views{};
};

/// Adds splats to sums in fixed point, of 64 bits and with steps of 2^−28, or makes light of these at once. Projected
/// splats are sorted into lists once for all targets; then each invocation of a program owns a few pixels of one
/// target, and gathers the lists that reach there. Made and used within on_gpu().
class SplatGatherer {
 public:
  SplatGatherer(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures, GpuTargets targets,
                std::span<const ViewPosition> views, std::span<const TargetGroup> groups, GpuWritten written);
  /// Where project_splats.comp writes: splats, and how far the widest of each kind reaches.
  const GpuBuffer& splats() const { return splats_; }
  const GpuBuffer& reaches() const { return reaches_; }
  /// Adds the first `count` projected splats to all targets or to one; if light is written, these must be all splats.
  /// Returns false if their lists do not fit into a buffer.
  bool add(std::size_t count, std::optional<int> target = {});
  /// The sums or the light of each group.
  std::vector<GpuBuffer> gathered() &&;

 private:
  std::size_t number_lists();
  void number_kinds(int picture, std::span<const float> reaches, int first_kind);
  std::size_t most_in_a_band(const GpuBuffer& begins, std::size_t in_lists) const;
  void gather(const GpuBuffer& ends, const GpuBuffer& entries, std::optional<int> target);

  const GpuPictures& pictures_;
  std::span<const TargetGroup> groups_;
  GpuKernel kernel_;
  ListWork work_;
  std::size_t most_entries_, most_by_one_;
  GpuBuffer splats_, reaches_;
  std::vector<GpuBuffer> sums_;
  std::vector<std::vector<char>> begun_;  // [group][picture]
  int next_kind_ = 0, next_list_ = 0;
};

}  // namespace wheatstone
