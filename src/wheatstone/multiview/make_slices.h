#pragma once

#include <memory>

#include "wheatstone/depth/viewing_geometry.h"
#include "wheatstone/multiview/render.h"
#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone {

/// Gathers particles into depth planes, chunk by chunk: memory stays at the slices and one chunk, however many
/// particles there are. `statistics` are those of all particles.
class SliceMaker {
 public:
  /// Slices reach as far to the sides as the rig's outermost views look. Throws Error{bad_input} where they
  /// would not fit in `memory_limit_bytes`, naming what was needed.
  SliceMaker(const Scene& scene, const CloudStatistics& statistics, const Rig& rig, const RenderOptions& options,
             std::size_t memory_limit_bytes = std::size_t{8} << 30);
  ~SliceMaker();
  SliceMaker(SliceMaker&&) noexcept;
  SliceMaker& operator=(SliceMaker&&) noexcept;

  /// Ranks (RenderOptions::ranks) add chunks in step, as `Chunks` gives them.
  void add(const Cloud& cloud);

  /// The slices, cropped to what is not empty; the maker is used up. An exposure that the options leave open is found
  /// from the central view. Of several ranks, the first has the slices.
  SliceStack finish(const ViewingGeometry& viewing);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// The slices of a cloud at once.
SliceStack make_slices(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options,
                       const ViewingGeometry& viewing);

}  // namespace wheatstone
