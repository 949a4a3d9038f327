#pragma once

#include <functional>
#include <span>
#include <vector>

#include "wheatstone/depth/view_position.h"
#include "wheatstone/multiview/chunks.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {

/// Those of a chunk's particles that shine in some view of a rig.
class ShiningParticles {
 public:
  ShiningParticles(const Cloud& chunk, const Scene& scene, std::span<const ViewPosition> views);

  bool empty() const { return cloud_.size() == 0; }
  /// The particles with the light of their highlights alone, as the view sees it (Cloud::presence).
  const Cloud& seen_from(ViewPosition view);

 private:
  /// A normal and the direction that mirrors the lamp, which moves along the rows as the direction of sight turns.
  struct Facing {
    float cosine, cosine_a_radian;  ///< between them, times the direction's length
    float square, square_a_radian;  ///< of that length, but for the square of the turn
    float light;                    ///< in the middle of the highlight
    float at(float turn, float sharpness) const;
  };
  float light_of(const Facing& facing, ViewPosition view) const {
    return facing.at((view - central_view) * shine_.turn, shine_.sharpness);
  }
  Shine shine_;
  Cloud cloud_;
  std::vector<Facing> facing_;
};

/// Calls `common` with every chunk of a job, and `highlights` with those of its particles that shine, as each of the
/// views sees them; never if nothing shines. The light of both is gathered separately, because sums depend on their
/// order, and chunks differ from rank to rank.
void for_each_chunk_and_highlights(const RenderJob& job, std::span<const ViewPosition> views,
                                   const std::function<void(const Cloud& chunk)>& common,
                                   const std::function<void(const Cloud& shining, std::size_t view)>& highlights);

/// Views between which highlights may be interpolated: no farther apart than a highlight's width allows.
std::vector<ViewPosition> shine_keys(const Shine& shine, std::span<const ViewPosition> views);

/// The share of each key's highlights in each view: shares[view][key]. At most two shares of a view are not 0, and they
/// sum to 1.
std::vector<std::vector<float>> shares_of_keys(std::span<const ViewPosition> keys, std::span<const ViewPosition> views);

}  // namespace wheatstone
