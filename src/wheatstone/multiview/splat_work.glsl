// What programs that project particles are given, and a particle as the central view has it. The twin of
// project_simd.cpp.

#include "wheatstone/gpu/views.glsl"

const int most_pictures = 9;
const int parallax_entries = 1024;
const int palette_entries = 256;

// As struct SplatWork in gpu_splats_internal.h has them.
layout(std430, binding = 0) readonly buffer Work {
  int particles, pictures;
  int column[9];  // where x, y, z, density, second, smoothing length, mass, presence, colour begin; -1: absent
  int by_mass, second_is_quantity, own_colours, logarithmic, from_density;
  int by_length, by_rank, larger_if_denser;
  float camera[3], right[3], down[3], forward[3];
  float focal_px, centre_x_px, centre_y_px, nearest_depth, orthographic_nearness;
  float first_w, entries_per_w;
  float mean_mass, radius_factor, fixed_radius, quantity_scale, log2_density_middle, slope, opacity, least_opacity;
  float smallest_px, largest_px, largest_mass_px, size_depth, palette_first, palette_scale;
  float widest[most_pictures], scale[most_pictures], pad[most_pictures];
  float parallax[parallax_entries], parallax_step[parallax_entries];
  float red[palette_entries], green[palette_entries], blue[palette_entries];
};
layout(std430, binding = 1) readonly buffer Columns { float columns[]; };

float column_of(int which, uint particle) { return columns[column[which] + int(particle)]; }
bool has(int which) { return column[which] >= 0; }

struct Splat {
  float x, y, parallax, size;
  vec3 light;
  int picture;
};

float sigmoid(float log2_density) { return 1 / (1 + exp2((log2_density_middle - log2_density) * slope)); }

float size_of(uint i, float log2_density, float nearness) {
  if (by_rank != 0) {
    float rank = sigmoid(log2_density);
    float share = larger_if_denser != 0 ? rank : 1 - rank;
    return clamp((smallest_px + share * (largest_px - smallest_px)) * (nearness * size_depth), smallest_px, largest_px);
  }
  float radius = fixed_radius;
  if (by_length != 0) {
    radius = column_of(5, i);
  } else if (from_density != 0) {
    radius = radius_factor * exp2(-log2_density / 3);
  }
  // Of mass: 5.5 deviations of the cubic spline kernel, each .27386 radii.
  float diameters = by_mass != 0 ? 5.5 * 0.27386 : 2.0;
  return min(max(radius * diameters * focal_px * nearness, smallest_px), by_mass != 0 ? largest_mass_px : largest_px);
}

float linear_of(uint byte) {
  float encoded = float(byte) / 255;
  return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}

vec3 own_colour(uint i) {
  uint code = floatBitsToUint(column_of(8, i));
  return vec3(linear_of(code & 255u), linear_of(code >> 8 & 255u), linear_of(code >> 16 & 255u));
}

float palette_entry(uint i, float log2_density) {
  float value = log2_density;
  if (has(4)) value = logarithmic != 0 ? log2(max(column_of(4, i), 1.17549435e-38)) : column_of(4, i);
  return clamp((value - palette_first) * palette_scale, 0.0, float(palette_entries - 1));
}

vec3 light_of_mass(uint i, float log2_density, float nearness) {
  float along = nearness * size_depth;
  float light = along * along;
  if (has(6)) light *= column_of(6, i) / mean_mass;
  if (has(7)) light *= column_of(7, i);
  if (own_colours != 0) return light * own_colour(i);
  float second = second_is_quantity != 0 ? column_of(4, i) * quantity_scale
                                         : palette_entry(i, log2_density) / float(palette_entries - 1);
  return vec3(light, light * second, 0);
}

vec3 light_of_look(uint i, float log2_density, float size) {
  float variance = size * size / 25;
  float shown = mix(least_opacity, opacity, sigmoid(log2_density)) * variance / (variance + 1.0 / 12);
  if (has(7)) shown *= column_of(7, i);
  if (own_colours != 0) return shown * own_colour(i);
  int entry = int(roundEven(palette_entry(i, log2_density)));
  return shown * vec3(red[entry], green[entry], blue[entry]);
}

// Moves a splat that is too wide to the smaller picture that fits, and dims it as its pixels are larger.
void choose_picture(inout Splat splat) {
  splat.picture = 0;
  for (int p = 0; p + 1 < pictures; ++p) splat.picture += int(splat.size > widest[p]);
  if (splat.picture == 0) return;
  float s = scale[splat.picture];
  splat.x = splat.x * s + pad[splat.picture];
  splat.y = splat.y * s + pad[splat.picture];
  splat.parallax *= s;
  splat.light *= s * s;
  splat.size = sqrt(splat.size * splat.size * s * s - 0.2 * 5.5 * 5.5);
}

// False where the camera does not see it.
bool project(uint i, out Splat splat) {
  vec3 at = vec3(column_of(0, i) - camera[0], column_of(1, i) - camera[1], column_of(2, i) - camera[2]);
  float depth = dot(at, vec3(forward[0], forward[1], forward[2]));
  if (!(depth > nearest_depth)) return false;
  float nearness = orthographic_nearness > 0 ? orthographic_nearness : 1 / depth;
  splat.x = dot(at, vec3(right[0], right[1], right[2])) * nearness * focal_px + centre_x_px;
  splat.y = dot(at, vec3(down[0], down[1], down[2])) * nearness * focal_px + centre_y_px;
  float entry = clamp((1 / depth - first_w) * entries_per_w, 0.0, float(parallax_entries - 1));
  splat.parallax = parallax[int(entry)] + fract(entry) * parallax_step[int(entry)];
  float log2_density = has(3) ? log2(max(column_of(3, i), 1.17549435e-38)) : 0;
  splat.size = size_of(i, log2_density, nearness);
  splat.light = by_mass != 0 ? light_of_mass(i, log2_density, nearness) : light_of_look(i, log2_density, splat.size);
  choose_picture(splat);
  return true;
}
