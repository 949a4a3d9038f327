#include "slices_argument.h"

#include <fmt/format.h>

#include <cmath>

#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/slice_file.h"

namespace wheatstone::cli {

RenderedParticles render_slice_file(const std::filesystem::path& file, const Given& given,
                                    const RenderParticlesOptions& options, const Progress& progress) {
  RenderedParticles result;
  result.format = "slices";
  result.stack = read_slices(file);
  if (!options.depth.regions.empty()) {
    map_depth(result.stack, options.depth.regions, options.depth.viewing);
  } else if (given("--near") || given("--far")) {
    const DepthMapping mapping = mapping_for(options.depth, result.stack.width, 1, 2);
    map_depth(result.stack, mapping.points.front().parallax_px, mapping.points.back().parallax_px);
  }
  if (result.stack.tone.look == Look::mass)
    refuse_options(given, {"--exposure"}, "on these slices; it works on slices of --look thesis");
  if (!std::isnan(options.rendering.exposure)) result.stack.tone.exposure = options.rendering.exposure;
  result.focus = options.rendering.focus;
  if (result.focus) {
    // It was told for views of another size.
    const float across = static_cast<float>(result.stack.width) / static_cast<float>(options.width);
    result.focus->x_px *= across;
    result.focus->y_px *= static_cast<float>(result.stack.height) / static_cast<float>(options.height);
    result.focus->radius_px *= across;
  }
  result.rig = evenly_spaced(result.stack.width, result.stack.height, options.views, options.span);
  result.rendered = {.views = options.without_views ? std::vector<Image<Rgb8>>{}
                                                    : render_slices(result.stack, result.rig, options.rendering.filter,
                                                                    progress, result.focus),
                     .method = Method::layered,
                     .reason = "layered: the file has slices",
                     .planes = static_cast<int>(result.stack.slices.size()),
                     .exposure = result.stack.tone.exposure,
                     .tone = result.stack.tone};
  if (options.span > result.stack.span * 1.001f)
    result.warnings.push_back(
        fmt::format("the slices were made for a span of {} eye separations; with {} the sides of the views lack light",
                    result.stack.span, options.span));
  return result;
}

}  // namespace wheatstone::cli
