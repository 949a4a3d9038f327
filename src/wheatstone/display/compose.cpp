#include "wheatstone/display/compose.h"

#include <fmt/format.h>

#include <algorithm>

#include "wheatstone/display/compose_gpu.h"
#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {
namespace {

using Views = std::span<const Image<Rgb8>>;

void check_two(Views views) {
  if (views.size() != 2)
    throw Error(ErrorKind::wrong_usage, fmt::format("there are {} views, expected those of two eyes", views.size()));
}

Image<Rgb8> composed(Views views, const LenticularScreen& screen) { return interleave(views, screen); }
Image<Rgb8> composed(Views views, const QuiltLayout& layout) { return make_quilt(views, layout); }
Image<Rgb8> composed(Views views, const AnaglyphKind& kind) {
  check_two(views);
  return anaglyph({views[0], views[1]}, kind);
}
Image<Rgb8> composed(Views views, StereoLayout layout) {
  check_two(views);
  return put_together(views[0], views[1], layout);
}

}  // namespace

Image<Rgb8> compose(Views views, const DisplayComposition& composition) {
  return std::visit([&](const auto& kind) { return composed(views, kind); }, composition);
}

Image<Rgb8> compose(Views views, const DisplayComposition& composition, Device device) {
  if (device != Device::graphics || !composes_on_gpu(composition)) return compose(views, composition);
  if (views.empty()) throw Error(ErrorKind::wrong_usage, "there are no views to compose");
  for (const Image<Rgb8>& view : views)
    if (!same_size(view, views.front()) || view.empty())
      throw Error(ErrorKind::wrong_usage, "the views of a display must be of one size");
  Image<Rgb8> picture;
  on_gpu([&](const GpuFacts& facts) {
    GpuComposer composer(composition, {views.front().width(), views.front().height(), views.size()}, facts);
    const std::size_t at_once = composer.views_at_once();
    for (std::size_t first = 0; first < views.size(); first += at_once)
      composer.take(views.subspan(first, std::min(at_once, views.size() - first)), first);
    picture = composer.picture();
  });
  return picture;
}

}  // namespace wheatstone
