#include "wheatstone/app/draw_composed.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "wheatstone/display/compose_gpu.h"
#include "wheatstone/drawing/draw_gpu.h"

namespace wheatstone {
namespace {

/// Nothing where the graphics processor does not draw or compose this.
std::optional<ComposedViews> composed_on_gpu(const PreparedPainting& painting, std::span<const ViewPosition> views,
                                             const DisplayComposition& composition) {
  // Where more is shown, tiles of the pixels that are shown cost more than all pixels.
  constexpr double most_shown = 0.2;
  if (!composes_on_gpu(composition)) return {};
  ComposedViews composed;
  const auto make_sink = [&](const GpuFacts& facts) {
    const ViewsToCompose to_compose{painting.width(), painting.height(), views.size()};
    const auto composer = std::make_shared<GpuComposer>(composition, to_compose, facts);
    GpuViewSink sink{.at_least = composer->least_at_once(),
                     .take = [composer](const GpuBuffer& pixels, std::size_t first,
                                        std::size_t count) { composer->take(pixels, first, count); },
                     .finish = [composer, &composed] { composed.picture = composer->picture(); }};
    if (composer->shown_share() <= most_shown)
      sink.wanted = [composer](std::size_t first, std::size_t count) { return composer->shown(first, count); };
    return sink;
  };
  const std::optional<double> bare_share = draw_on_gpu(painting, views, make_sink);
  if (!bare_share) return {};
  composed.worst_bare_share = *bare_share;
  return composed;
}

ComposedViews draw_quilt(const PreparedPainting& painting, std::span<const ViewPosition> views,
                         const QuiltLayout& layout) {
  ComposedViews composed{Image<Rgb8>(layout.columns * painting.width(), layout.rows * painting.height())};
  const ViewSink put = [&](std::size_t place, DrawnView view) {
    composed.worst_bare_share = std::max(composed.worst_bare_share, view.bare_share);
    put_into_quilt(view.picture, static_cast<int>(place), layout, composed.picture);
  };
  draw(painting, views, put);
  return composed;
}

}  // namespace

ComposedViews draw_composed(const PreparedPainting& painting, std::span<const ViewPosition> views,
                            const DisplayComposition& composition) {
  if (std::optional<ComposedViews> composed = composed_on_gpu(painting, views, composition))
    return *std::move(composed);
  if (const auto* const layout = std::get_if<QuiltLayout>(&composition)) return draw_quilt(painting, views, *layout);
  ComposedViews composed;
  std::vector<Image<Rgb8>> drawn;
  const ViewSink keep = [&](std::size_t /*place*/, DrawnView view) {
    composed.worst_bare_share = std::max(composed.worst_bare_share, view.bare_share);
    drawn.push_back(std::move(view.picture));
  };
  draw(painting, views, keep);
  composed.picture = compose(drawn, composition);
  return composed;
}

}  // namespace wheatstone
