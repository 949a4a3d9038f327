#include "wheatstone/multiview/render.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/multiview/cost_model_internal.h"
#include "wheatstone/multiview/make_slices.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/multiview/splat_internal.h"

namespace wheatstone {

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

float automatic_exposure(const Cloud& cloud, const Scene& scene, const Rig& rig) {
  CloudStatistics statistics;
  statistics.add(cloud);
  return settled({}, scene, statistics, rig).exposure;
}

ToneSettings tone_found(const CloudStatistics& statistics, const Scene& scene, const Rig& rig,
                        const RenderOptions& options) {
  return settled(tone_for(scene, options), scene, statistics, rig);
}

ToneSettings tone_for(const Scene& scene, const RenderOptions& options) {
  ToneSettings tone = options.tone;
  tone.look = scene.splat_style.look;
  tone.exposure = options.exposure;
  // Absorbing particles never add up to more than their own colour, which is shown unchanged.
  if (tone.look == Look::thesis)
    tone.stretch = scene.splat_style.blend == Blend::over ? Stretch::linear : Stretch::asinh;
  if (scene.splat_style.colour_source == ColourSource::own) tone.shown = Shown::colours;
  if (scene.splat_style.colour_source == ColourSource::quantity) tone.shown = Shown::mean;
  return tone;
}

float column_of_light(const Scene& scene) {
  const float px_a_unit = scene.camera.focal_px / scene.splat_style.size_depth;
  return scene.splat_style.mean_mass * px_a_unit * px_a_unit;
}

namespace {

void check(const Scene& scene, const Rig& rig, const RenderOptions& options) {
  if (rig.positions.empty()) throw Error(ErrorKind::wrong_usage, "there are 0 views, expected at least 1");
  if (rig.width <= 0 || rig.height <= 0)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("views are {}x{} pixels, expected at least 1x1", rig.width, rig.height));
  if (scene.mapping.points.empty()) throw Error(ErrorKind::wrong_usage, "the depth mapping has no point");
  if (options.focus) check_focus(*options.focus, look_around_px(scene, rig));
  if (options.focus && (options.method == Method::exact || options.method == Method::incremental))
    throw Error(ErrorKind::wrong_usage, "--focus: the depth planes are moved, expected --method auto or layered");
  if (options.planes < 0)
    throw Error(ErrorKind::wrong_usage, fmt::format("there are {} depth planes, expected at least 1", options.planes));
}

/// The graphics processor adds light, in one process: into views with highlights, or into depth planes without them.
/// The only particles that hide others which it draws are opaque discs of the thesis's look, into views. Everything
/// else is refused here.
void check_gpu_can(const Scene& scene, const RenderOptions& options) {
  const bool planes = options.method == Method::layered || options.focus.has_value();
  struct Refused {
    bool is_wanted;
    std::string_view what, expected = "--device cpu";
  };
  const Refused all[] = {
      {scene.splat_style.blend == Blend::over, "--blend over"},
      {scene.shine.lit() && planes, "--shine with --method layered or --focus"},
      {options.opaque && (planes || scene.splat_style.look == Look::mass),
       "--opaque with --look mass, --method layered or --focus"},
      {!options.ranks.alone(), "under mpirun"},
      {options.method == Method::exact, "by --method exact", "auto, incremental or layered, or --device cpu"}};
  for (const Refused& refused : all)
    if (refused.is_wanted)
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("--device gpu does not render {}, expected {}", refused.what, refused.expected));
}

/// The diameter, in the picture that it is drawn in, of a splat of mean area.
float typical_splat_px(const CloudStatistics& statistics, const Scene& scene) {
  const SplatStyle& style = scene.splat_style;
  const bool by_rank = style.size_rule == SizeRule::denser_smaller || style.size_rule == SizeRule::denser_larger;
  const Cloud& sample = statistics.sample.cloud();
  if (style.look == Look::thesis || by_rank || sample.size() == 0) return (style.smallest_px + style.largest_px) / 2;
  const float px_a_radius =
      mass_diameters(style.kernel) * deviations_a_radius * scene.camera.focal_px / style.size_depth;
  const bool own = style.size_rule == SizeRule::smoothing_length && !sample.smoothing_length.empty();
  const std::size_t every = sample.size() / 4096 + 1;
  double area = 0;
  double count = 0;
  for (std::size_t i = 0; i < sample.size(); i += every, ++count) {
    float radius = style.fixed_radius;
    if (own) {
      radius = sample.smoothing_length[i];
    } else if (!sample.density.empty()) {
      radius = style.radius_factor / std::cbrt(sample.density[i]);
    }
    float diameter = std::max(radius * px_a_radius, style.smallest_px);
    while (diameter > widest_mass_px) diameter /= 2;
    area += std::pow(diameter + 1, 2);
  }
  return static_cast<float>(std::sqrt(area / count)) - 1;
}

Workload workload_of(const CloudStatistics& statistics, const Scene& scene, const Rig& rig,
                     const RenderOptions& options) {
  const DepthPlanes planes = planes_of(scene.mapping, options.planes, span_of(rig));
  return {.particles = statistics.count,
          .splat_px = typical_splat_px(statistics, scene),
          .mass = scene.splat_style.look == Look::mass,
          .views = static_cast<int>(rig.positions.size()),
          .planes = static_cast<int>(planes.parallaxes.size()),
          .pixels = static_cast<std::uint64_t>(rig.width) * rig.height,
          .absorbs = scene.splat_style.blend == Blend::over};
}

MethodChoice choose(const CloudStatistics& statistics, const Scene& scene, const Rig& rig,
                    const RenderOptions& options) {
  if (options.method != Method::automatic) return {options.method, "as asked for"};
  if (options.focus) return {Method::layered, "layered: the focus moves depth planes"};
  return choose_method(workload_of(statistics, scene, rig, options));
}

MethodChoice choose_on_gpu(const RenderJob& job, const RenderOptions& options) {
  if (options.method != Method::automatic) return {options.method, "as asked for"};
  if (options.opaque) return {Method::incremental, "on a graphics processor, opaque: incremental"};
  if (options.focus) return {Method::layered, "layered: the focus moves depth planes"};
  if (job.scene.shine.lit()) return {Method::incremental, "on a graphics processor, with highlights: incremental"};
  return choose_gpu_method(workload_of(job.statistics, job.scene, job.rig, options));
}

/// False where the processor is to render.
bool rendered_on_gpu(const RenderJob& job, std::span<const ImageView<Rgb8>> pictures, const RenderOptions& options,
                     RenderedViews& result) {
  constexpr std::uint64_t worthwhile = 10'000'000;  // particles × views
  const std::uint64_t work = job.statistics.count * job.rig.positions.size();
  if (!chooses_gpu(options.device, options.ranks.alone() && work >= worthwhile)) return false;
  return done_on_gpu(options.device, [&] {
    check_gpu_can(job.scene, options);
    const MethodChoice choice = choose_on_gpu(job, options);
    if (choice.method == Method::layered) {
      const DepthPlanes planes = planes_of(job.scene.mapping, options.planes, span_of(job.rig));
      render_layered_on_gpu(job, planes, options.filter, pictures);
      result.planes = static_cast<int>(planes.parallaxes.size());
    } else {
      render_incremental_on_gpu(job, options.opaque, pictures);
    }
    result.device = gpu_facts().name;
    result.method = choice.method;
    result.reason = choice.reason;
  });
}

/// By slices that hide what is behind them.
void render_hiding_slices(const RenderJob& job, const RenderOptions& options, RenderedViews& result) {
  RenderOptions with_exposure = options;
  with_exposure.exposure = result.exposure;
  SliceMaker maker(job.scene, job.statistics, job.rig, with_exposure);
  job.chunks([&](const Cloud& chunk) { maker.add(chunk); });
  const SliceStack stack = maker.finish({});
  if (job.ranks.first()) result.views = render_slices(stack, job.rig, options.filter, {}, options.focus);
}

/// Some of the views by the method that was chosen; the exact one gets them one by one.
void render_views(const RenderJob& job, Method method, bool opaque, std::span<const ViewPosition> views,
                  std::span<const ImageView<Rgb8>> pictures) {
  if (opaque) return render_opaque(job, views, pictures);
  if (job.scene.splat_style.blend == Blend::over) {
    std::vector<ViewTarget> targets;
    for (const ImageView<Rgb8> picture : pictures) targets.push_back({.picture = picture});
    return render_front_to_back(job, views, targets);
  }
  if (method == Method::incremental) return render_incremental(job, pictures);
  render_exact(job, views, pictures);
}

}  // namespace

RenderedViews render(const Cloud& cloud, const Scene& scene, const Rig& rig, const RenderOptions& options,
                     const Progress& progress) {
  CloudStatistics statistics;
  statistics.add(cloud);
  return render(chunks_of(cloud, options.ranks), statistics, scene, rig, options, progress);
}

RenderedViews render(const Chunks& chunks, const CloudStatistics& statistics, const Scene& scene, const Rig& rig,
                     const RenderOptions& options, const Progress& progress) {
  check(scene, rig, options);
  RenderedViews result;
  result.tone = tone_found(statistics, scene, rig, options);
  result.exposure = result.tone.exposure;
  const MethodChoice choice = choose(statistics, scene, rig, options);
  result.method = choice.method;
  result.reason = choice.reason;
  result.views.reserve(rig.positions.size());
  for (std::size_t v = 0; v < rig.positions.size(); ++v) result.views.emplace_back(rig.width, rig.height);
  const std::vector<ImageView<Rgb8>> pictures(result.views.begin(), result.views.end());
  const ToneMap tone(result.tone);
  const RenderJob job{chunks, scene, rig, statistics, tone, options.focus, options.ranks};

  report(progress, "views", 0);
  result.device = "cpu";
  if (rendered_on_gpu(job, pictures, options, result)) {
    report(progress, "views", 1);
    return result;
  }
  if (result.method == Method::layered) {
    const DepthPlanes planes = planes_of(scene.mapping, options.planes, span_of(rig));
    result.planes = static_cast<int>(planes.parallaxes.size());
    if (options.opaque || scene.splat_style.blend == Blend::over) {
      render_hiding_slices(job, options, result);
    } else {
      render_layered(job, planes, options.filter, pictures);
    }
  } else if (result.method == Method::incremental) {
    render_views(job, result.method, options.opaque, rig.positions, pictures);
  } else {
    for (std::size_t v = 0; v < pictures.size(); ++v) {
      render_views(job, result.method, options.opaque, std::span(rig.positions).subspan(v, 1),
                   std::span(pictures).subspan(v, 1));
      report(progress, "views", static_cast<double>(v + 1) / static_cast<double>(pictures.size()));
    }
  }
  report(progress, "views", 1);
  return result;
}

std::vector<ViewValues> view_values(const Chunks& chunks, const CloudStatistics& statistics, const Scene& scene,
                                    const Rig& rig, const Ranks& ranks) {
  ToneSettings as_mass{.look = Look::mass, .least = 0, .most = 1};
  const ToneMap tone(as_mass);
  const float unit = column_of_light(scene);
  Scene without_shine = scene;  // which is no mass
  without_shine.shine = {};
  // Colours of particles are light of three channels, whose sums are no mass.
  ColourSource& colours = without_shine.splat_style.colour_source;
  if (colours == ColourSource::own) colours = ColourSource::density;
  const bool with_quantity = scene.splat_style.colour_source == ColourSource::quantity;
  std::vector<ViewValues> values;
  for (const ViewPosition view : rig.positions) {
    const ViewLight light = light_of_view({chunks, without_shine, rig, statistics, tone, {}, ranks}, view);
    ViewValues& of_view = values.emplace_back();
    of_view.column = Image<float>(rig.width, rig.height);
    if (with_quantity) of_view.mean = Image<float>(rig.width, rig.height);
    for (int y = 0; y < rig.height; ++y)
      for (int x = 0; x < rig.width; ++x) {
        const float column = light.row(y, 0)[x];
        of_view.column(x, y) = column * unit;
        if (with_quantity)
          of_view.mean(x, y) = column > 0 ? light.row(y, 1)[x] / column / scene.splat_style.quantity_scale
                                          : std::numeric_limits<float>::quiet_NaN();
      }
  }
  return values;
}

}  // namespace wheatstone
