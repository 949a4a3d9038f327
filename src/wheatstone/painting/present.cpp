#include "wheatstone/painting/present.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <utility>

#include "wheatstone/display/compose_gpu.h"
#include "wheatstone/drawing/draw_gpu.h"

namespace wheatstone {
namespace {

/// Nothing where the graphics processor does not draw or compose this.
std::optional<Presented> composed_on_gpu(const PreparedPainting& painting, const Presentation& presentation) {
  // If a larger share of the pixels is shown, drawing tiles of these costs more than drawing all pixels.
  constexpr double most_shown = 0.2;
  const DisplayComposition& composition = *presentation.composition;
  if (!presentation.backgrounds.empty() || !composes_on_gpu(composition)) return {};
  Presented presented;
  const auto make_sink = [&](const GpuFacts& facts) {
    const ViewsToCompose to_compose{painting.width(), painting.height(), presentation.views.size()};
    const auto composer = std::make_shared<GpuComposer>(composition, to_compose, facts);
    GpuViewSink sink{.at_least = composer->least_at_once(),
                     .take = [composer](const GpuBuffer& pixels, std::size_t first,
                                        std::size_t count) { composer->take(pixels, first, count); },
                     .finish = [composer, &presented] { presented.composed = composer->picture(); }};
    if (composer->shown_share() <= most_shown)
      sink.wanted = [composer](std::size_t first, std::size_t count) { return composer->shown(first, count); };
    return sink;
  };
  const std::optional<double> bare_share = draw_on_gpu(painting, presentation.views, make_sink);
  if (!bare_share) return {};
  presented.worst_bare_share = *bare_share;
  return presented;
}

/// The share of the pixels, 0..1, of the part that shows the painting.
double bare_share_of(const DrawnView& view, const CoveredPart& covered) {
  std::int64_t bare = 0;
  for (int y = covered.top; y < covered.bottom; ++y) {
    const auto row = view.bare.row(y);
    bare += (covered.right - covered.left) - std::count(row.begin() + covered.left, row.begin() + covered.right, 0);
  }
  const double pixels = static_cast<double>(covered.right - covered.left) * (covered.bottom - covered.top);
  return static_cast<double>(bare) / std::max(pixels, 1.0);
}

}  // namespace

Presented present(const Painting& painting, const Presentation& presentation) {
  const std::optional<DisplayComposition>& composition = presentation.composition;
  const std::optional<CoveredPart>& covered = presentation.covered;
  const DrawOptions options{.placement = presentation.placement, .deep = presentation.deep && !composition && !covered};
  const PreparedPainting prepared = prepare(painting, options, presentation.device);
  if (composition && !covered)
    if (std::optional<Presented> presented = composed_on_gpu(prepared, presentation)) return *std::move(presented);
  Presented presented;
  const auto* const quilt = composition ? std::get_if<QuiltLayout>(&*composition) : nullptr;
  if (quilt != nullptr)
    presented.composed = Image<Rgb8>(quilt->columns * prepared.width(), quilt->rows * prepared.height());
  const ViewSink take = [&](std::size_t place, DrawnView view) {
    if (covered) {
      view.bare_share = bare_share_of(view, *covered);
      put_bars(*covered, view.picture);
    }
    presented.worst_bare_share = std::max(presented.worst_bare_share, view.bare_share);
    if (quilt != nullptr) return put_into_quilt(view.picture, static_cast<int>(place), *quilt, presented.composed);
    presented.bare_shares.push_back(view.bare_share);
    presented.views.push_back(std::move(view.picture));
    if (!view.deep.empty()) presented.deep.push_back(std::move(view.deep));
  };
  draw(prepared, presentation.views, take, presentation.backgrounds);
  if (!composition || quilt != nullptr) return presented;
  presented.composed = compose(presented.views, *composition);
  presented.views.clear();
  presented.bare_shares.clear();
  return presented;
}

}  // namespace wheatstone
