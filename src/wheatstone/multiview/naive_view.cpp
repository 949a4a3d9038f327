#include "wheatstone/multiview/naive_view.h"

#include <algorithm>
#include <cmath>

#include "wheatstone/image/colour.h"
#include "wheatstone/multiview/slice_stack.h"

namespace wheatstone {
namespace {

struct NaiveSplat {
  float x = 0, y = 0, size = 0;
  LinearRgba light;
  bool seen = false;
};

float along_axis(const std::array<float, 3>& a, const std::array<float, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

LinearRgba colour_of(const Cloud& cloud, std::size_t i, const SplatStyle& splat_style) {
  if (splat_style.colour_source == ColourSource::own)
    return {linear_from_srgb(cloud.colour[i].r), linear_from_srgb(cloud.colour[i].g),
            linear_from_srgb(cloud.colour[i].b), 0};
  float value = 0;
  if (splat_style.colour_source == ColourSource::temperature) {
    value = splat_style.logarithmic ? std::log2(cloud.temperature[i]) : cloud.temperature[i];
  } else if (!cloud.density.empty()) {
    value = std::log2(cloud.density[i]);
  }
  const float at =
      std::clamp((value - splat_style.palette_first) * splat_style.palette_scale, 0.f, SplatStyle::palette_size - 1.f);
  const auto entry = static_cast<std::size_t>(std::lround(at));
  return {splat_style.red[entry], splat_style.green[entry], splat_style.blue[entry], 0};
}

NaiveSplat project(const Cloud& cloud, std::size_t i, const Scene& scene, ViewPosition view) {
  const Camera& camera = scene.camera;
  const SplatStyle& splat_style = scene.splat_style;
  const std::array<float, 3> from_camera{cloud.x[i] - camera.position[0], cloud.y[i] - camera.position[1],
                                         cloud.z[i] - camera.position[2]};
  NaiveSplat splat;
  const float depth = along_axis(from_camera, camera.forward);
  if (!(depth > camera.nearest_depth)) return splat;
  splat.seen = true;
  splat.x = camera.centre_x_px + camera.focal_px * along_axis(from_camera, camera.right) / depth;
  splat.y = camera.centre_y_px + camera.focal_px * along_axis(from_camera, camera.down) / depth;
  splat.x += (view - central_view) * parallax_px(scene.mapping, depth);

  // Hassaine 2010, sec. 4.2: a sigmoid of the density makes opacity and size.
  const float log2_density = cloud.density.empty() ? 0.f : std::log2(cloud.density[i]);
  const float rank = 1 / (1 + std::exp2(-splat_style.slope * (log2_density - splat_style.log2_density_middle)));
  if (splat_style.size_rule == SizeRule::smoothing_length && !cloud.smoothing_length.empty()) {
    splat.size = 2 * cloud.smoothing_length[i] * camera.focal_px / depth;
  } else {
    const float share = splat_style.size_rule == SizeRule::denser_larger ? rank : 1 - rank;
    splat.size = (splat_style.smallest_px + share * (splat_style.largest_px - splat_style.smallest_px)) *
                 splat_style.size_depth / depth;
  }
  splat.size = std::clamp(splat.size, splat_style.smallest_px, splat_style.largest_px);
  const float variance = splat.size * splat.size / 25;
  const float opacity = (splat_style.least_opacity + rank * (splat_style.opacity - splat_style.least_opacity)) *
                        variance / (variance + 1.f / 12);
  const LinearRgba colour = colour_of(cloud, i, splat_style);
  splat.light = {opacity * colour.r, opacity * colour.g, opacity * colour.b, 0};
  return splat;
}

void draw(const NaiveSplat& splat, Image<LinearRgba>& picture) {
  const float reach = splat.size / 2 + 0.5f;
  const float variance = splat.size * splat.size / 25 + 1.f / 12;
  const int first_y = std::max(static_cast<int>(std::ceil(splat.y - reach - 0.5f)), 0);
  const int last_y = std::min(static_cast<int>(std::floor(splat.y + reach - 0.5f)), picture.height() - 1);
  const int first_x = std::max(static_cast<int>(std::ceil(splat.x - reach - 0.5f)), 0);
  const int last_x = std::min(static_cast<int>(std::floor(splat.x + reach - 0.5f)), picture.width() - 1);
  for (int y = first_y; y <= last_y; ++y)
    for (int x = first_x; x <= last_x; ++x) {
      const float dx = static_cast<float>(x) + 0.5f - splat.x;
      const float dy = static_cast<float>(y) + 0.5f - splat.y;
      const float weight = std::exp(-(dx * dx + dy * dy) / (2 * variance));
      LinearRgba& pixel = picture(x, y);
      pixel.r += weight * splat.light.r;
      pixel.g += weight * splat.light.g;
      pixel.b += weight * splat.light.b;
    }
}

}  // namespace

Image<Rgb8> naive_view(const Cloud& cloud, const Scene& scene, const Rig& rig, ViewPosition view, float exposure) {
  Image<LinearRgba> light(rig.width, rig.height);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const NaiveSplat splat = project(cloud, i, scene, view);
    if (splat.seen) draw(splat, light);
  }
  Image<Rgb8> picture(rig.width, rig.height);
  const auto shown = [exposure](float value) { return srgb_from_linear(exposure * value / (1 + exposure * value)); };
  for (int y = 0; y < rig.height; ++y)
    for (int x = 0; x < rig.width; ++x)
      picture(x, y) = {shown(light(x, y).r), shown(light(x, y).g), shown(light(x, y).b)};
  return picture;
}

}  // namespace wheatstone
