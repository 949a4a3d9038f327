#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {

/// The targets that particles are added to (splat_lists.glsl); in discs_in_views each pixel shows its nearest disc.
enum class GpuTargets : std::int32_t { views = 0, nearest_plane = 1, between_planes = 2, discs_in_views = 3 };

/// What gathering writes: new sums, additions to sums, or light if all particles are gathered at once.
enum class GpuWritten : std::int32_t { sums = 0, more_sums = 1, light = 2 };

/// The pictures of every size (SplatOrder), as the graphics processor keeps what is added to them: target after target,
/// which is a view or a depth plane, then row after row, pixel after pixel, channel after channel.
struct GpuPictures {
  SplatOrders orders;
  std::vector<int> left, width;  ///< of each picture: first column in the central view, and number of columns
  std::vector<int> targets;      ///< of each picture: number of targets
  int channels = 2;

  std::size_t size() const { return orders.size(); }
  std::size_t pixels(std::size_t picture) const {
    return static_cast<std::size_t>(width[picture]) * orders[picture].rows;
  }
  /// Numbers of a target of one picture.
  std::size_t values(std::size_t picture) const { return pixels(picture) * channels; }
};

GpuPictures gpu_pictures(const SplatOrders& orders, const Window& window, int channels);

/// Some targets of every picture, whose sums lie in one buffer.
struct TargetGroup {
  std::vector<int> first, end;  ///< of each picture
  std::vector<int> base;        ///< of each picture: where target 0 would lie; below 0 where it lies in another buffer
  std::size_t values = 0;       ///< in all
};

/// The targets of all pictures, picture after picture, in groups of at most so many numbers each. Throws
/// Error{wrong_usage} where one target has more.
std::vector<TargetGroup> groups_of_targets(const GpuPictures& pictures, std::size_t most_values);

/// A sum in fixed point is two words.
constexpr std::size_t sum_bytes = 2 * sizeof(std::uint32_t);

/// The light of all targets, and which of the groups' buffers hold it.
struct LightOnGpu {
  std::vector<TargetGroup> groups;
  std::vector<GpuBuffer> light;  ///< [group]
};

/// Adds every particle to all targets: copied, projected and lit once. Within on_gpu().
LightOnGpu light_on_gpu(const RenderJob& job, const GpuFacts& facts, const GpuPictures& pictures, GpuTargets targets,
                        std::span<const ViewPosition> views);

}  // namespace wheatstone
