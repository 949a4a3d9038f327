// The still life's light: a low sun through a window on the left, the room's own light, and soft shadows in closed
// form, so that they are free of noise and the same for every view.
#include <algorithm>

#include "wheatstone/synthetic/synthetic_still_internal.h"

namespace wheatstone::still {
namespace {

const Vec3 to_window = normalised({-0.62f, 0.60f, -0.50f});
constexpr Vec3 key_light{3.30f, 2.60f, 1.78f};
constexpr Vec3 sky_light{0.24f, 0.30f, 0.40f};
constexpr Vec3 table_light{0.29f, 0.165f, 0.09f};
constexpr float least_room_share = 1 / 36.f;  ///< casters that hide less of the room than this are passed over
constexpr float sun_spread = 0.075f;  ///< tangent of half the angle under which the window's bright part is seen

/// Share of the window's light that passes an ellipsoid; half-shadows widen with the distance.
float light_past(const ShadowCaster& caster, Vec3 point) {
  const Vec3 inverse{1 / caster.radii.x, 1 / caster.radii.y, 1 / caster.radii.z};
  const Vec3 o = caster.pose.point_in(point) * inverse, d = caster.pose.direction_in(to_window) * inverse;
  const float size = length(d), nearest = -dot(o, d) / size;
  if (nearest <= 0) return 1;
  const float beside = std::sqrt(std::max(dot(o, o) - nearest * nearest, 0.f));
  const float half_shadow = 0.03f + sun_spread * nearest;
  const float passed = smooth_step(1 - half_shadow, 1 + half_shadow, beside);
  return mix(passed, 1.f, 1 - caster.opacity * smooth_step(0, 0.15f, nearest));
}

/// Share of the room's light that an ellipsoid takes from a point, after the sphere of the same size.
float room_light_past(const ShadowCaster& caster, Vec3 point, Vec3 normal) {
  const Vec3 to_caster = caster.pose.origin - point;
  const float square = dot(to_caster, to_caster), radius = caster.mean_radius;
  const float distance = std::sqrt(square);
  const float facing = clamp01(0.5f * (dot(normal, to_caster) / distance + 0.6f) / 0.8f);
  const float seen = clamp01(radius * radius / square - least_room_share);
  return 1 - 0.85f * caster.opacity * facing * seen;
}

/// Panes of light on the wall: where the light's way to a point crosses the window's plane.
float light_through_window(Vec3 point) {
  constexpr float window_x = -1;
  const float way = (window_x - point.x) / to_window.x;
  const Vec3 crossing = point + to_window * way;
  if (point.z < wall_z - 0.25f) return 1;
  const float soft = 0.010f + 0.013f * std::max(way, 0.f);
  const auto bar = [&](float v, float half_width) {
    return smooth_step(half_width - soft, half_width + soft, std::abs(v));
  };
  const float sides =
      smooth_step(1.02f - soft, 1.02f + soft, crossing.z) * (1 - smooth_step(1.74f - soft, 1.74f + soft, crossing.z));
  const float ends =
      smooth_step(0.72f - soft, 0.72f + soft, crossing.y) * (1 - smooth_step(1.80f - soft, 1.80f + soft, crossing.y));
  const float bars =
      bar(crossing.z - 1.38f, 0.022f) * bar(crossing.y - 1.08f, 0.022f) * bar(crossing.y - 1.44f, 0.022f);
  return 0.13f + 0.87f * sides * ends * bars;
}

/// Marks the casters that may shade a point: within their reach, or beside the light's way by no more than that.
void mark_near(const CasterReach& reach, Vec3 point, std::uint8_t* near) {
  const std::size_t count = reach.x.size();
  const float *x = reach.x.data(), *y = reach.y.data(), *z = reach.z.data();
  const float *shadow = reach.shadow.data(), *ambient_square = reach.ambient_square.data();
  for (std::size_t i = 0; i < count; ++i) {
    const float dx = x[i] - point.x, dy = y[i] - point.y, dz = z[i] - point.z;
    const float square = dx * dx + dy * dy + dz * dz;
    const float along = dx * to_window.x + dy * to_window.y + dz * to_window.z;
    const float wide = shadow[i] + sun_spread * along;
    const bool in_light = (along > -shadow[i]) & (square - along * along < wide * wide);
    near[i] = static_cast<std::uint8_t>((square < ambient_square[i]) | in_light);
  }
}

}  // namespace

CasterReach reach_of(const std::vector<ShadowCaster>& casters) {
  CasterReach reach;
  for (const ShadowCaster& caster : casters) {
    const Vec3 centre = caster.pose.origin;
    reach.x.push_back(centre.x);
    reach.y.push_back(centre.y);
    reach.z.push_back(centre.z);
    const float largest = std::max({caster.radii.x, caster.radii.y, caster.radii.z});
    reach.shadow.push_back(largest * 1.03f + 0.01f);
    reach.ambient_square.push_back(caster.mean_radius * caster.mean_radius / least_room_share);
  }
  return reach;
}

Illumination illumination_at(const Scene& scene, Vec3 point, Vec3 normal, int group) {
  Illumination light{light_through_window(point), 1};
  int within = -1;
  for (const Mouth& mouth : scene.mouths) {
    const Vec3 off = point - mouth.centre;
    if (off.y > 0.02f || off.y < -mouth.depth) continue;
    const float from_axis = std::hypot(off.x, off.z);
    if (from_axis > mouth.radius || (group != mouth.group && from_axis > mouth.radius * 0.98f)) continue;
    const bool outer_wall = group == mouth.group && dot(normal, {off.x, 0, off.z}) > 0;
    if (outer_wall) continue;
    within = mouth.group;
    const float way = std::max(-off.y, 0.f) / to_window.y;
    const Vec3 crossing = off + to_window * way;
    const float soft = 0.004f + sun_spread * way;
    light.key *= 1 - smooth_step(mouth.radius - soft, mouth.radius + soft, std::hypot(crossing.x, crossing.z));
    light.ambient *= mix(1.f, 0.32f, clamp01(-off.y / mouth.depth));
  }
  std::array<std::uint8_t, most_casters> near;
  mark_near(scene.reach, point, near.data());
  for (std::size_t i = 0; i < scene.casters.size(); ++i) {
    if (near[i] == 0) continue;
    const ShadowCaster& caster = scene.casters[i];
    if (caster.group == group || caster.group == within) continue;
    if (light.key > 0.004f) light.key *= light_past(caster, point);
    light.ambient *= room_light_past(caster, point, normal);
  }
  return light;
}

Vec3 shade(const Finish& finish, Vec3 point, Vec3 normal, const Illumination& light) {
  // A tenth of the light reaches round the edge, so that shadows on round things are soft.
  const float facing = dot(normal, to_window), wrap = 0.10f + 0.5f * finish.translucence;
  const float key = light.key * clamp01((facing + wrap) / (1 + wrap));
  const float up = 0.5f + 0.5f * normal.y, side = 0.62f + 0.38f * clamp01(0.5f - 0.8f * normal.x + 0.2f * normal.y);
  const Vec3 room = mix(table_light, sky_light, up) * (light.ambient * side);
  Vec3 colour = finish.colour * (key_light * key + room);

  const Vec3 to_eye = normalised(cyclopean_eye - point);
  const Vec3 half_way = normalised(to_eye + to_window);
  const float highlight = finish.gloss * std::pow(clamp01(dot(normal, half_way)), finish.sharpness);
  const float grazing = std::pow(1 - clamp01(dot(normal, to_eye)), 4.f);
  colour += key_light * (0.42f * highlight * light.key);
  colour += sky_light * (0.5f * finish.gloss * grazing * light.ambient);

  // Light from the window falls off into the room, and the picture's corners rest a little darker.
  const float falloff = mix(1.10f, 0.74f, smooth_step(-0.7f, 0.9f, point.x));
  colour = colour * falloff;
  // A shoulder that keeps bright things coloured.
  const auto shoulder = [](float v) { return v * (1 + v / 7.5f) / (1 + v); };
  return {shoulder(1.18f * colour.x), shoulder(1.18f * colour.y), shoulder(1.18f * colour.z)};
}

std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed) {
  std::uint32_t h = x * 0x8da6b343u ^ y * 0xd8163841u ^ z * 0xcb1ab31fu ^ seed * 0x9e3779b1u;
  h = (h ^ (h >> 15)) * 0x2c1b3c6du;
  h = (h ^ (h >> 12)) * 0x297a2d39u;
  return h ^ (h >> 15);
}

FourNoises four_noises_at(const FourPlaces& p, FourWords seed) {
  // std::floor is a call where the processor's instruction is not taken for granted.
  using Whole = std::int32_t __attribute__((vector_size(16)));
  const auto floor_of = [](FourFloats v) {
    const Whole cut = __builtin_convertvector(v, Whole);
    return cut + (__builtin_convertvector(cut, FourFloats) > v);  // a comparison gives −1 where it holds
  };
  const Whole left = floor_of(p.x), bottom = floor_of(p.y), front = floor_of(p.z);
  const auto within = [](FourFloats v, Whole floor) { return v - __builtin_convertvector(floor, FourFloats); };
  const FourFloats sx = within(p.x, left), sy = within(p.y, bottom), sz = within(p.z, front);
  const auto ease = [](FourFloats v) { return v * v * v * (v * (v * 6 - 15) + 10); };
  const auto ease_slope = [](FourFloats v) { return 30 * v * v * (v * (v - 2) + 1); };
  const FourFloats ux = ease(sx), uy = ease(sy), uz = ease(sz);

  constexpr std::uint32_t step_x = 0x8da6b343u, step_y = 0xd8163841u, step_z = 0xcb1ab31fu;
  const auto words = [](Whole v) { return __builtin_convertvector(v, FourWords); };
  const FourWords salt = seed * 0x9e3779b1u, rows = words(bottom) * step_y;
  const FourWords x0 = words(left) * step_x, x1 = x0 + step_x, y0 = rows ^ salt, y1 = (rows + step_y) ^ salt,
                  z0 = words(front) * step_z, z1 = z0 + step_z;
  const auto corner = [](FourWords hx, FourWords hy, FourWords hz) {
    FourWords mixed = hx ^ hy ^ hz;
    mixed = (mixed ^ (mixed >> 15)) * 0x2c1b3c6du;
    return __builtin_convertvector(__builtin_convertvector(mixed, Whole), FourFloats) * 0x1p-31f;
  };
  const FourFloats a = corner(x0, y0, z0), b = corner(x1, y0, z0), c = corner(x0, y1, z0), d = corner(x1, y1, z0);
  const FourFloats e = corner(x0, y0, z1), f = corner(x1, y0, z1), g = corner(x0, y1, z1), h = corner(x1, y1, z1);
  const FourFloats k1 = b - a, k2 = c - a, k3 = e - a, k4 = a - b - c + d, k5 = a - c - e + g, k6 = a - b - e + f;
  const FourFloats k7 = -a + b + c - d + e - f - g + h;
  return {a + k1 * ux + k2 * uy + k3 * uz + k4 * ux * uy + k5 * uy * uz + k6 * uz * ux + k7 * ux * uy * uz,
          {ease_slope(sx) * (k1 + k4 * uy + k6 * uz + k7 * uy * uz),
           ease_slope(sy) * (k2 + k5 * uz + k4 * ux + k7 * uz * ux),
           ease_slope(sz) * (k3 + k6 * ux + k5 * uy + k7 * ux * uy)}};
}

Noise noise_at(Vec3 p, std::uint32_t seed) {
  const FourNoises four = four_noises_at({FourFloats{p.x}, FourFloats{p.y}, FourFloats{p.z}}, FourWords{seed});
  return {four.value[0], {four.slope.x[0], four.slope.y[0], four.slope.z[0]}};
}

}  // namespace wheatstone::still
