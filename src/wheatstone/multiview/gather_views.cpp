#include <tbb/enumerable_thread_specific.h>

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
/// As many views' bands as are drawn at a time: they stay within a second-level cache.
constexpr std::size_t views_in_cache = 3;

/// Memory of one group of views that the next one uses again: fresh memory costs more than what few particles do in it.
struct GatheringMemory {
  OrderingMemory ordering;
  /// Bands of some views, for each picture and thread.
  std::vector<tbb::enumerable_thread_specific<std::vector<LightBand>>> bands;
};

/// The light of some views, gathered at the same time. One view is projected for itself; several share the splats of
/// the central view, which are moved for each. The last splats are drawn when their bands become pictures: if there are
/// no others, the light of whole views is never kept.
class ViewGatherer {
 public:
  ViewGatherer(const RenderJob& job, std::span<const ViewPosition> views, GatheringMemory& memory)
      : job_(job),
        views_(views),
        orders_(orders_for(job)),
        kind_(deposit_of(job.scene.splat_style)),
        shown_{.left = 0, .right = static_cast<float>(job.rig.width), .height = job.rig.height},
        memory_(memory),
        waiting_(memory.ordering, [this](const std::vector<SplatBlock>& blocks) { add_to_light(blocks); }) {
    if (job.scene.shine.lit()) highlights_.emplace(orders_, shown_, kind_, static_cast<int>(views.size()));
    memory.bands.resize(orders_.size());
  }
  void gather();
  /// The light becomes pictures, from the smallest picture to the views' own; without pictures it stays light.
  ViewPyramid finish(std::span<const ImageView<Rgb8>> pictures);

 private:
  /// One enlarged frustum holds what any view sees (Hassaine 2010, sec. 4.3.1).
  Window seen() const {
    const float around = views_.size() > 1 ? look_around_px(job_.scene, job_.rig) : 0;
    return {.left = -around, .right = shown_.right + around, .height = shown_.height};
  }
  void deposit_band(const std::vector<SplatBlock>& blocks, std::size_t picture, int b,
                    std::span<const ViewPosition> views, std::span<LightBand> bands) const;
  void add_to_light(const std::vector<SplatBlock>& blocks);
  std::span<LightBand> band_in_views(std::size_t picture, int b, std::size_t first, std::size_t count);

  const RenderJob& job_;
  std::span<const ViewPosition> views_;
  SplatOrders orders_;
  Deposit kind_;
  Window shown_;
  GatheringMemory& memory_;
  WaitingBlocks waiting_;
  std::optional<GatheredLight> light_;  ///< of all splats but the waiting ones
  std::optional<GatheredLight> highlights_;
};

/// Adds splats to a band of some of the views.
void ViewGatherer::deposit_band(const std::vector<SplatBlock>& blocks, std::size_t picture, int b,
                                std::span<const ViewPosition> views, std::span<LightBand> bands) const {
  const SplatOrder& order = orders_[picture];
  const int top = b * order.band_rows;
  for (int part = 0; part < order.parts; ++part)
    for (const SplatBlock& block : blocks) {
      const std::span<const Splat> splats = block.bin(order.bin(b, part));
      if (views_.size() == 1) {
        deposit(kind_, splats, top, bands.front());
      } else {
        deposit_in_views(kind_, splats, top, views, bands);
      }
    }
}

void ViewGatherer::add_to_light(const std::vector<SplatBlock>& blocks) {
  if (!light_) light_.emplace(orders_, shown_, kind_, static_cast<int>(views_.size()));
  for_each_band(orders_, [&](std::size_t picture, int b) {
    deposit_band(blocks, picture, b, views_, light_->band_in_targets(picture, b));
  });
}

void ViewGatherer::gather() {
  const Projection projection = projection_for(job_, orders_, views_.size() == 1 ? views_.front() : central_view);
  const Window window = seen();
  const auto take = [&](const Cloud& particles, const std::function<void(std::vector<SplatBlock>)>& draw) {
    const Chunks chunks = chunks_of(particles);
    for_each_ordered(of_chunks(job_, chunks), projection, window, orders_, memory_.ordering, draw);
  };
  // Few particles have highlights: only these are gathered again, for each view on its own.
  for_each_chunk_and_highlights(
      job_, views_,
      [&](const Cloud& chunk) {
        take(chunk, [&](std::vector<SplatBlock> blocks) { waiting_.add(std::move(blocks)); });
      },
      [&](const Cloud& shining, std::size_t view) {
        take(shining, [&](const std::vector<SplatBlock>& blocks) {
          for_each_band(orders_, [&](std::size_t picture, int b) {
            deposit_band(blocks, picture, b, views_.subspan(view, 1),
                         highlights_->band_in_targets(picture, b).subspan(view, 1));
          });
        });
      });
}

/// The light of a band in some of the views, without what is waiting: dark where everything is.
std::span<LightBand> ViewGatherer::band_in_views(std::size_t picture, int b, std::size_t first, std::size_t count) {
  if (light_) return light_->band_in_targets(picture, b).subspan(first, count);
  std::vector<LightBand>& bands = memory_.bands[picture].local();
  while (bands.size() < count)
    bands.push_back(dark_band(orders_[picture], shown_, kind_, static_cast<int>(bands.size())));
  for (LightBand& band : bands) band.darken();
  return std::span(bands).first(count);
}

ViewPyramid ViewGatherer::finish(std::span<const ImageView<Rgb8>> pictures) {
  ViewPyramid pyramid(orders_, job_.rig, views_.size(), job_.tone.three_channels());
  for (std::size_t p = orders_.size(); p-- > 0;) {
    const std::vector<ViewTarget> targets = pyramid.targets(p, pictures);
    for_each_band_of(orders_[p], [&](int b) {
      for (std::size_t first = 0; first < views_.size(); first += views_in_cache) {
        const std::size_t count = std::min(views_in_cache, views_.size() - first);
        const std::span<LightBand> bands = band_in_views(p, b, first, count);
        deposit_band(waiting_.blocks(), p, b, views_.subspan(first, count), bands);
        for (std::size_t v = 0; v < count; ++v) {
          if (highlights_) bands[v].add(highlights_->band(p, b, static_cast<int>(first + v)));
          finish_band(bands[v], job_.tone, b * orders_[p].band_rows, targets[first + v]);
        }
      }
    });
    pyramid.share(p, targets, job_.ranks);
  }
  waiting_.give_back();
  return pyramid;
}

void render_some_at_a_time(const RenderJob& job, std::size_t at_a_time, std::span<const ViewPosition> views,
                           std::span<const ImageView<Rgb8>> pictures) {
  GatheringMemory memory;
  for (std::size_t first = 0; first < views.size(); first += at_a_time) {
    const std::size_t count = std::min(at_a_time, views.size() - first);
    ViewGatherer gatherer(job, views.subspan(first, count), memory);
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
  GatheringMemory memory;
  ViewGatherer gatherer(job, {&view, 1}, memory);
  gatherer.gather();
  return gatherer.finish({}).light(0);
}

}  // namespace wheatstone
