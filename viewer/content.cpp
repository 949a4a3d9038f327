#include "content.h"

#include "wheatstone/depth/convergence.h"

namespace wheatstone::viewer {
namespace {

struct SizeOf {
  ContentSize operator()(std::monostate) const { return {}; }
  ContentSize operator()(const PaintedContent& content) const {
    if (content.painting) return {width_of(*content.painting), height_of(*content.painting)};
    return {content.photograph->pictures.left.width(), content.photograph->pictures.left.height()};
  }
  ContentSize operator()(const ViewsContent& content) const {
    return {content.views->front().width(), content.views->front().height()};
  }
  ContentSize operator()(const SlicesContent& content) const { return {content.slices->width, content.slices->height}; }
  ContentSize operator()(const ParticlesContent& /*content*/) const { return {}; }
};

std::optional<ContentDepth> ends_of(ImageView<const float> disparity) {
  const DepthEnds ends = depth_ends(disparity);
  return ContentDepth{ends.farthest_px, ends.nearest_px};
}

}  // namespace

ContentSize size_of(const Content& content) { return std::visit(SizeOf(), content); }

std::optional<ContentDepth> depth_of(const Content& content) {
  if (const auto* const painted = std::get_if<PaintedContent>(&content)) {
    if (painted->painting && !painted->painting->surfaces.seen.empty())
      return ends_of(painted->painting->surfaces.seen.front().disparity);
    if (painted->photograph && painted->photograph->geometry)
      return ends_of(painted->photograph->geometry->left_disparity);
  }
  if (const auto* const sliced = std::get_if<SlicesContent>(&content))
    if (!sliced->slices->slices.empty())
      return ContentDepth{-sliced->slices->slices.back().parallax_px, -sliced->slices->slices.front().parallax_px};
  return {};
}

}  // namespace wheatstone::viewer
