#include "content.h"

#include "wheatstone/depth/convergence.h"

namespace wheatstone::viewer {
namespace {

struct SizeOf {
  PictureSize operator()(std::monostate) const { return {}; }
  PictureSize operator()(const PaintedContent& content) const {
    if (content.painting) return {width_of(*content.painting), height_of(*content.painting)};
    return {content.photograph->pictures.left.width(), content.photograph->pictures.left.height()};
  }
  PictureSize operator()(const ViewsContent& content) const {
    return {content.views->front().width(), content.views->front().height()};
  }
  PictureSize operator()(const SlicesContent& content) const { return {content.slices->width, content.slices->height}; }
  PictureSize operator()(const ParticlesContent& /*content*/) const { return {}; }
};

}  // namespace

PictureSize size_of(const Content& content) { return std::visit(SizeOf(), content); }

std::optional<DepthEnds> depth_of(const Content& content) {
  if (const auto* const painted = std::get_if<PaintedContent>(&content)) {
    if (painted->painting && !painted->painting->surfaces.seen.empty())
      return depth_ends(painted->painting->surfaces.seen.front().disparity);
    if (painted->photograph && painted->photograph->geometry)
      return depth_ends(painted->photograph->geometry->left_disparity);
  }
  if (const auto* const sliced = std::get_if<SlicesContent>(&content))
    if (!sliced->slices->slices.empty())
      return DepthEnds{-sliced->slices->slices.back().parallax_px, -sliced->slices->slices.front().parallax_px};
  return {};
}

}  // namespace wheatstone::viewer
