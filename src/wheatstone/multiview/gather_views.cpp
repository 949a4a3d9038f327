#include <algorithm>
#include <functional>
#include <optional>
#include <utility>

#include "wheatstone/multiview/gathered_light_internal.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/shine_internal.h"

namespace wheatstone {
namespace {

/// As many views as are filled at a time: their light stays within the memory that one picture of each takes.
constexpr std::size_t views_at_a_time = 16;

/// The light of some views, gathered at the same time. One view is projected for itself; several share the splats of
/// the central view, which are moved for each.
class ViewGatherer {
 public:
  ViewGatherer(const RenderJob& job, std::span<const ViewPosition> views)
      : job_(job),
        views_(views),
        orders_(orders_for(job)),
        kind_(deposit_of(job.scene.splat_style)),
        shown_{.left = 0, .right = static_cast<float>(job.rig.width), .height = job.rig.height},
        light_(orders_, shown_, kind_, static_cast<int>(views.size())) {
    if (job.scene.shine.lit()) highlights_.emplace(orders_, shown_, kind_, static_cast<int>(views.size()));
  }
  void gather();
  /// The light becomes pictures, from the smallest picture to the views' own; without pictures it stays light.
  ViewPyramid finish(std::span<const ImageView<Rgb8>> pictures);

 private:
  void deposit_in(const std::vector<SplatBlock>& blocks, std::size_t first, std::size_t count, GatheredLight& light);
  /// One enlarged frustum holds what any view sees (Hassaine 2010, sec. 4.3.1).
  Window seen() const {
    const float around = views_.size() > 1 ? look_around_px(job_.scene, job_.rig) : 0;
    return {.left = -around, .right = shown_.right + around, .height = shown_.height};
  }

  const RenderJob& job_;
  std::span<const ViewPosition> views_;
  SplatOrders orders_;
  Deposit kind_;
  Window shown_;
  GatheredLight light_;
  std::optional<GatheredLight> highlights_;
};

/// Adds splats to some of the views, `count` of them from the first on.
void ViewGatherer::deposit_in(const std::vector<SplatBlock>& blocks, std::size_t first, std::size_t count,
                              GatheredLight& light) {
  for_each_band(orders_, [&](std::size_t picture, int b) {
    const SplatOrder& order = orders_[picture];
    const int top = b * order.band_rows;
    const std::span<LightBand> bands = light.band_in_targets(picture, b).subspan(first, count);
    for (int part = 0; part < order.parts; ++part)
      for (const SplatBlock& block : blocks) {
        const std::span<const Splat> splats = block.bin(order.bin(b, part));
        if (views_.size() == 1) {
          deposit(kind_, splats, top, bands.front());
        } else {
          deposit_in_views(kind_, splats, top, views_.subspan(first, count), bands);
        }
      }
  });
}

void ViewGatherer::gather() {
  const Projection projection = projection_for(job_, orders_, views_.size() == 1 ? views_.front() : central_view);
  const Window window = seen();
  OrderingMemory memory;
  WaitingBlocks waiting(memory, [&](const auto& blocks) { deposit_in(blocks, 0, views_.size(), light_); });
  const auto take = [&](const Cloud& particles, const std::function<void(std::vector<SplatBlock>)>& draw) {
    const Chunks chunks = chunks_of(particles);
    for_each_ordered(of_chunks(job_, chunks), projection, window, orders_, memory, draw);
  };
  // Few particles have highlights: only these are gathered again, for each view on its own.
  for_each_chunk_and_highlights(
      job_, views_,
      [&](const Cloud& chunk) { take(chunk, [&](std::vector<SplatBlock> blocks) { waiting.add(std::move(blocks)); }); },
      [&](const Cloud& shining, std::size_t view) {
        take(shining, [&](const std::vector<SplatBlock>& blocks) { deposit_in(blocks, view, 1, *highlights_); });
      });
  waiting.finish();
  if (highlights_) light_.add(*highlights_);
}

ViewPyramid ViewGatherer::finish(std::span<const ImageView<Rgb8>> pictures) {
  ViewPyramid pyramid(orders_, job_.rig, views_.size(), job_.tone.three_channels());
  for (std::size_t p = orders_.size(); p-- > 0;) {
    const std::vector<ViewTarget> targets = pyramid.targets(p, pictures);
    for_each_band_of(orders_[p], [&](int b) {
      for (std::size_t v = 0; v < views_.size(); ++v)
        finish_band(light_.band(p, b, static_cast<int>(v)), job_.tone, b * orders_[p].band_rows, targets[v]);
    });
    pyramid.share(p, targets, job_.ranks);
  }
  return pyramid;
}

void render_some_at_a_time(const RenderJob& job, std::size_t at_a_time, std::span<const ViewPosition> views,
                           std::span<const ImageView<Rgb8>> pictures) {
  for (std::size_t first = 0; first < views.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, views.size() - first);
    ViewGatherer gatherer(job, views.subspan(first, count));
    gatherer.gather();
    gatherer.finish(pictures.subspan(first, count));
  }
}

}  // namespace

void render_exact(const RenderJob& job, std::span<const ViewPosition> views,
                  std::span<const ImageView<Rgb8>> pictures) {
  render_some_at_a_time(job, 1, views, pictures);
}

void render_incremental(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures) {
  render_some_at_a_time(job, views_at_a_time, job.rig.positions, pictures);
}

ViewLight light_of_view(const RenderJob& job, ViewPosition view) {
  if (job.scene.splat_style.blend == Blend::over) {
    ViewLight seen(job.rig.width, job.rig.height, 3);
    const ViewTarget target{.light = &seen};
    render_front_to_back(job, {&view, 1}, {&target, 1});
    return seen;
  }
  ViewGatherer gatherer(job, {&view, 1});
  gatherer.gather();
  return gatherer.finish({}).light(0);
}

}  // namespace wheatstone
