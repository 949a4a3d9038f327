#include <algorithm>
#include <cmath>
#include <utility>

#include "wheatstone/multiview/renderers_internal.h"
#include "wheatstone/percentile.h"

namespace wheatstone {
namespace {

/// A scene and rig of a smaller picture of some of the particles.
struct SampledScene {
  Scene scene;
  Rig rig;
  float light = 1;  ///< that a unit of the small picture's light is in the whole one
};

/// A quarter of the width and height, so that a pixel holds at least as many particles as in the whole picture. They
/// are wider, as the sample is thinner. With few particles in the thesis's look, the picture keeps its size.
SampledScene sampled_scene(const Scene& scene, const CloudStatistics& statistics, const Rig& rig) {
  const auto taken = static_cast<float>(std::max<std::size_t>(statistics.sample.cloud().size(), 1));
  const float every = static_cast<float>(statistics.count) / taken;
  const bool mass = scene.splat_style.look == Look::mass;
  const float scale =
      mass || every > 1 ? std::max(0.25f, 16.f / static_cast<float>(std::min(rig.width, rig.height))) : 1.f;
  SampledScene small{scene, rig};
  small.scene.shine = {};
  if (scale < 1) {
    small.rig.width = static_cast<int>(std::ceil(static_cast<float>(rig.width) * scale));
    small.rig.height = static_cast<int>(std::ceil(static_cast<float>(rig.height) * scale));
    small.scene.camera.focal_px *= scale;
    small.scene.camera.centre_x_px *= scale;
    small.scene.camera.centre_y_px *= scale;
  }
  small.light = every * std::min(scale * scale, 1.f);
  SplatStyle& style = small.scene.splat_style;
  style.radius_factor *= std::cbrt(every);
  style.fixed_radius *= std::cbrt(every);
  if (style.blend == Blend::over) {
    // Each particle of the sample absorbs as much as all the particles that it represents.
    style.opacity *= small.light;
    style.least_opacity *= small.light;
    small.light = 1;
  }
  return small;
}

/// The sample, its kernels as wide as they are when there are no other particles.
Cloud spread(Cloud sample, std::uint64_t count) {
  const float wider =
      std::cbrt(static_cast<float>(count) / static_cast<float>(std::max<std::size_t>(sample.size(), 1)));
  for (float& length : sample.smoothing_length) length *= wider;
  return sample;
}

float exposure_for(std::vector<float> brightest, Stretch stretch) {
  // Where the tone map puts the brighter parts of what is lit: their 99th percentile.
  constexpr float target = 0.75f;
  if (brightest.empty()) return 1;
  return (stretch == Stretch::linear ? target : target / (1 - target)) / percentile(std::move(brightest), 0.99);
}

/// Limits that the settings leave open: percentiles of what is shown.
void set_limits(ToneSettings& settings, std::vector<float> values) {
  const auto at = [&](double share, float otherwise) { return values.empty() ? otherwise : percentile(values, share); };
  const bool number = settings.shown == Shown::mean || settings.shown == Shown::column;
  const bool open_below = std::isnan(settings.least);
  // A picture is dark where there is nothing; numbers begin where most of them do.
  if (std::isnan(settings.least)) settings.least = number || settings.stretch == Stretch::log ? at(0.01, 0) : 0;
  if (std::isnan(settings.most)) settings.most = at(0.999, 1);
  // Rims of kernels are as faint as one likes: a found limit shows four decades at most.
  if (settings.stretch == Stretch::log && (open_below || !(settings.least > 0)))
    settings.least = std::max(settings.least, settings.most * 1e-4f);
  if (!(settings.most > settings.least)) settings.most = settings.least + std::max(std::abs(settings.least), 1e-20f);
}

}  // namespace

ToneSettings settled(const ToneSettings& settings, const Scene& scene, const CloudStatistics& statistics,
                     const Rig& rig) {
  ToneSettings found = settings;
  found.look = scene.splat_style.look;
  const bool thesis = found.look == Look::thesis;
  const bool known = thesis ? !std::isnan(found.exposure) : !std::isnan(found.least) && !std::isnan(found.most);
  if (known) return found;
  const SampledScene small = sampled_scene(scene, statistics, rig);
  const Cloud sample = spread(statistics.sample.cloud(), statistics.count);
  ToneSettings any = found;
  any.exposure = any.most = 1;
  any.least = 0;
  const ToneMap tone(any);
  const ViewLight light = light_of_view({chunks_of(sample), small.scene, small.rig, statistics, tone}, central_view);
  std::vector<float> values;
  for (int y = 0; y < small.rig.height; ++y)
    for (int x = 0; x < small.rig.width; ++x) {
      const float first = light.row(y, 0)[x];
      const float second = light.row(y, 1)[x];
      float value = first * small.light;
      if (light.channels() == 3) value = std::max({first, second, light.row(y, 2)[x]}) * small.light;
      if (value > 0) values.push_back(found.shown == Shown::mean && !thesis ? second / first : value);
    }
  if (thesis) {
    found.exposure = exposure_for(std::move(values), found.stretch);
  } else {
    set_limits(found, std::move(values));
  }
  return found;
}

}  // namespace wheatstone
