#pragma once

#include <functional>
#include <span>
#include <utility>
#include <vector>

#include "wheatstone/multiview/light_band_internal.h"
#include "wheatstone/multiview/renderers_internal.h"

namespace wheatstone {

/// The pictures that splats are drawn in (SplatOrder): the view's, and for mass as many smaller ones as its widest
/// splats need. Without planes, splats are ordered by columns.
SplatOrders orders_for(const RenderJob& job);
SplatOrders orders_by_plane(const RenderJob& job, const DepthPlanes& planes, SliceFilter filter);

/// The projection for these pictures.
Projection projection_for(const RenderJob& job, const SplatOrders& orders, ViewPosition view = central_view);

/// Columns of a picture that a window of the view covers.
Window window_in(const Window& window, const SplatOrder& order);

/// A band of a picture in which nothing is drawn. `number` tells apart bands that are written in turn.
LightBand dark_band(const SplatOrder& order, const Window& window, Deposit kind, int number);

/// Light in all pictures: band by band, and in each as many targets as there are views or depth planes. Only the bands
/// of this rank are there.
class GatheredLight {
 public:
  GatheredLight(const SplatOrders& orders, const Window& window, Deposit kind, int targets);
  /// Light of the same pictures and targets.
  void add(const GatheredLight& light);
  LightBand& band(std::size_t picture, int band, int target) {
    return light_[picture][static_cast<std::size_t>(band) * targets_of(picture) + target];
  }
  std::span<LightBand> band_in_targets(std::size_t picture, int band) {
    return std::span(light_[picture])
        .subspan(static_cast<std::size_t>(band) * targets_of(picture), targets_of(picture));
  }
  int targets_of(std::size_t picture) const { return targets_[picture]; }
  /// Moves all ranks' bands to the first of them.
  void move_to_first(const Ranks& ranks);

 private:
  SplatOrders orders_;
  Window window_;
  Deposit kind_;
  std::vector<int> targets_;
  std::vector<std::vector<LightBand>> light_;
};

/// Orders the splats of every chunk, some ten thousand particles at a time, and calls `take` with them. Ranks give each
/// other what belongs to their bands: each takes the splats of its bands, of all ranks' chunks, in the order in which
/// one rank alone would.
void for_each_ordered(const RenderJob& job, const Projection& projection, const Window& window,
                      const SplatOrders& orders, OrderingMemory& memory,
                      const std::function<void(std::vector<SplatBlock>)>& take);

/// Blocks of splats that are waiting to be drawn. The more blocks are drawn at a time, the more splats lie in each bin,
/// and the less often its light is fetched. The number of blocks drawn at a time depends on the blocks alone, because
/// sums of light depend on their order.
class WaitingBlocks {
 public:
  using Draw = std::function<void(const std::vector<SplatBlock>& blocks)>;
  /// Blocks that were drawn go back to `memory` for reuse.
  WaitingBlocks(OrderingMemory& memory, Draw draw) : memory_(memory), draw_(std::move(draw)) {}
  void add(std::vector<SplatBlock> blocks);
  /// Draws what is left.
  void finish();
  /// What is left, for those who draw it themselves and give it back then.
  const std::vector<SplatBlock>& blocks() const { return blocks_; }
  void give_back();

 private:
  OrderingMemory& memory_;
  Draw draw_;
  std::vector<SplatBlock> blocks_;
};

/// Calls `work` with each of this rank's bands of a picture, in parallel.
void for_each_band_of(const SplatOrder& order, const std::function<void(int band)>& work);

/// Calls `work` with each of this rank's bands of every picture, in parallel.
void for_each_band(const SplatOrders& orders, const std::function<void(std::size_t picture, int band)>& work);

/// The light of each picture's views while they are put together, from the smallest picture to the views' own.
class ViewPyramid {
 public:
  ViewPyramid(const SplatOrders& orders, const Rig& rig, std::size_t views, bool three_channels);
  /// The targets of a picture's views. Those of the view's own picture are `pictures`, or light where there are none.
  std::vector<ViewTarget> targets(std::size_t picture, std::span<const ImageView<Rgb8>> pictures);
  /// Gives the ranks' bands of a picture's targets to the others: those of smaller pictures to all, which need them for
  /// the next larger one, and those of the view's own to the first.
  void share(std::size_t picture, std::span<const ViewTarget> targets, const Ranks& ranks) const;
  /// The light of the view's own picture, if it was not converted to bytes.
  const ViewLight& light(std::size_t view) const { return light_[0][view]; }

 private:
  SplatOrders orders_;
  Rig rig_;
  bool three_channels_;
  std::size_t views_;
  std::vector<std::vector<ViewLight>> light_;  // [picture][view]
};

}  // namespace wheatstone
