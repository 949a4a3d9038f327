#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "wheatstone/gpu/buffer.h"
#include "wheatstone/gpu/program.h"
#include "wheatstone/gpu/views.h"
#include "wheatstone/image/image.h"
#include "wheatstone/multiview/gpu_splats_internal.h"
#include "wheatstone/multiview/tone_map_internal.h"

namespace wheatstone {

/// The light of a picture's views on the graphics processor, from a place in a buffer on.
struct GpuLight {
  const GpuBuffer* light;
  int base;
};

/// Puts the pictures of all sizes together, from the smallest on, and shows the views' own. `light_of` is asked once
/// for each, in that order; what it gives must stay until it is asked again. Within on_gpu().
void finish_on_gpu(const GpuPictures& pictures, const ToneMap& tone,
                   const std::function<GpuLight(std::size_t picture)>& light_of,
                   std::span<const ImageView<Rgb8>> views);

/// Composites views from the light of depth planes. Made and used within on_gpu().
class GpuCompositor {
 public:
  GpuCompositor(const GpuPictures& planes, LightOnGpu light, SliceFilter filter, std::optional<Focus> focus);
  /// The light of a picture's views.
  GpuBuffer composite(std::size_t picture, const GpuPictures& of_views, std::span<const ViewPosition> views) const;

 private:
  const GpuProgram& program() const;

  const GpuPictures& planes_;
  std::vector<TargetGroup> groups_;
  SliceFilter filter_;
  std::optional<Focus> focus_;
  std::vector<GpuBuffer> packed_;              // [group]
  std::vector<std::vector<int>> first_texel_;  // [group][picture]: where plane 0 would lie
};

}  // namespace wheatstone
