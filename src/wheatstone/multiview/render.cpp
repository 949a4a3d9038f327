#include "wheatstone/multiview/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/multiview/cost_model.h"
#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/percentile.h"

namespace wheatstone {

SplatOrder bands_of(const Rig& rig, const SplatStyle& splat_style) {
  SplatOrder order;
  // A splat must not reach into more than two bands.
  static_assert(SplatStyle::widest_px + 2 <= 32);
  order.band_rows = 32;
  order.bands = (rig.height + order.band_rows - 1) / order.band_rows;
  order.spacing = std::max(64.f, splat_style.largest_px);
  order.parts = static_cast<int>(static_cast<float>(rig.width) / order.spacing) + 1;
  return order;
}

float look_around_px(const Scene& scene, const Rig& rig) {
  float parallax = 0;
  for (const DepthMapping::Point& point : scene.mapping.points)
    parallax = std::max(parallax, std::abs(point.parallax_px));
  float farthest = 0;
  for (const ViewPosition view : rig.positions) farthest = std::max(farthest, std::abs(view - central_view));
  return parallax * farthest;
}

float span_of(const Rig& rig) {
  if (rig.positions.empty()) return 0;
  const auto [first, last] = std::ranges::minmax(rig.positions);
  return last - first;
}

float exposure_for(std::vector<float> brightest) {
  // Where the tone map puts the brighter parts of what is lit: their 99th percentile.
  constexpr float target = 0.75f;
  std::erase_if(brightest, [](float light) { return light <= 0; });
  if (brightest.empty()) return 1;
  return target / (1 - target) / percentile(std::move(brightest), 0.99);
}

float automatic_exposure(const Cloud& cloud, const Scene& scene, const Rig& rig) {
  CloudStatistics statistics;
  statistics.add(cloud);
  std::vector<float> brightest;
  for (const LightBand& band : light_of_view(cloud, scene, rig, statistics, central_view))
    for (int row = 0; row < band.rows(); ++row)
      for (int x = 0; x < rig.width; ++x) {
        const float* const pixel = band.row(row) + x * LightBand::channels;
        brightest.push_back(std::max({pixel[0], pixel[1], pixel[2]}));
      }
  return exposure_for(std::move(brightest));
}

namespace {

void check(const Scene& scene, const Rig& rig, const RenderOptions& options) {
  if (rig.positions.empty()) throw Error(ErrorKind::wrong_usage, "there are 0 views, expected at least 1");
  if (rig.width <= 0 || rig.height <= 0)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("views are {}x{} pixels, expected at least 1x1", rig.width, rig.height));
  if (scene.mapping.points.empty()) throw Error(ErrorKind::wrong_usage, "the depth mapping has no point");
  if (options.planes < 0)
    throw Error(ErrorKind::wrong_usage, fmt::format("there are {} depth planes, expected at least 1", options.planes));
}

Choice choose(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options) {
  if (options.method != Method::automatic) return {options.method, "as asked for"};
  const DepthPlanes planes = planes_of(scene.mapping, options.planes, span_of(rig));
  return choose_method({.particles = cloud.size(),
                        .splat_px = (scene.splat_style.smallest_px + scene.splat_style.largest_px) / 2,
                        .views = static_cast<int>(rig.positions.size()),
                        .planes = static_cast<int>(planes.parallaxes.size()),
                        .pixels = static_cast<std::uint64_t>(rig.width) * rig.height});
}

void render_opaque_slices(const RenderJob& job, const RenderOptions& options, RenderedViews& result) {
  RenderOptions with_exposure = options;
  with_exposure.exposure = result.exposure;
  result.views = render_slices(make_slices(job.cloud, job.scene, job.rig, with_exposure, {}), job.rig);
}

}  // namespace

RenderedViews render(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options,
                     const Progress& progress) {
  check(scene, rig, options);
  CloudStatistics statistics;
  statistics.add(cloud);
  RenderedViews result;
  result.exposure = std::isnan(options.exposure) ? automatic_exposure(cloud, scene, rig) : options.exposure;
  const Choice choice = choose(cloud, scene, rig, options);
  result.method = choice.method;
  result.reason = choice.reason;
  result.views.assign(rig.positions.size(), Image<Rgb8>(rig.width, rig.height));
  const std::vector<ImageView<Rgb8>> pictures(result.views.begin(), result.views.end());
  const ToneMap tone(result.exposure);
  const RenderJob job{cloud, scene, rig, statistics, tone};

  if (result.method == Method::layered) {
    const DepthPlanes planes = planes_of(scene.mapping, options.planes, span_of(rig));
    result.planes = static_cast<int>(planes.parallaxes.size());
    if (options.opaque) {
      render_opaque_slices(job, options, result);
    } else {
      render_layered(job, planes, options.filter, pictures);
    }
  } else if (options.opaque && result.method == Method::incremental) {
    render_opaque(job, rig.positions, pictures);
  } else if (result.method == Method::incremental) {
    render_incremental(job, pictures);
  } else {
    for (std::size_t v = 0; v < pictures.size(); ++v) {
      report(progress, "views", static_cast<double>(v) / static_cast<double>(pictures.size()));
      if (options.opaque) {
        render_opaque(job, std::span(rig.positions).subspan(v, 1), std::span(pictures).subspan(v, 1));
      } else {
        render_exact(job, rig.positions[v], pictures[v]);
      }
    }
  }
  report(progress, "views", 1);
  return result;
}

}  // namespace wheatstone
