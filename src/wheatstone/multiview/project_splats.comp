#version 450

// Particles are projected and lit once, for all views: a splat in the central view, and its kind. The twin of
// project_simd.cpp. KIND_OF_LIGHT says what is shown.
// Variant: KIND_OF_LIGHT=0
// Variant: KIND_OF_LIGHT=1
#define OF_LOOK 0
#define OF_MASS 1

layout(local_size_x = 64) in;

#include "wheatstone/multiview/splat_kinds.glsl"

const int most_pictures = 9;
const int parallax_entries = 1024;
const int palette_entries = 256;

// The members of struct SplatWork in gpu_splats.cpp.
layout(std140, binding = 0) uniform Work {
  int particles, pictures;
  int second_is_quantity, own_colours, logarithmic, from_density;
  int by_length, by_rank, larger_if_denser;
  float first_w, entries_per_w;
  float diameters, spread;  // of a splat of mass its size over its radius; by what enlarging a picture spreads it
  float orthographic_nearness, mean_mass, radius_factor, fixed_radius, quantity_scale, log2_density_middle, slope;
  float opacity, least_opacity, smallest_px, largest_px, largest_mass_px, size_depth, palette_first, palette_scale;
  vec4 camera, right, down, forward;  // and focal length, centre x, centre y, nearest depth
  ivec4 columns_of[3];  // where x, y, z, density, second, smoothing length, mass, presence, colour begin; -1: absent
  vec4 fits[most_pictures];  // widest splat, scale, pad
};
layout(std430, binding = 1) readonly buffer Columns { float columns[]; };
// Parallaxes and from each to the next; then the palette's colours, and the light of each encoded byte.
layout(binding = 0) uniform usamplerBuffer tables;

int column(int which) { return columns_of[which >> 2][which & 3]; }
float column_of(int which, uint particle) { return columns[column(which) + int(particle)]; }
bool has(int which) { return column(which) >= 0; }

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
  return KIND_OF_LIGHT == OF_MASS ? clamp(radius * diameters * camera.w * nearness, smallest_px, largest_mass_px)
                                  : clamp(radius * 2 * camera.w * nearness, smallest_px, largest_px);
}

vec4 table_entry(int entry) { return uintBitsToFloat(texelFetch(tables, entry)); }

float linear_of(uint byte) { return table_entry(parallax_entries + int(byte)).a; }

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
  return shown * table_entry(parallax_entries + int(roundEven(palette_entry(i, log2_density)))).rgb;
}

// Moves a splat that is too wide to the smaller picture that fits, and dims it as its pixels are larger.
void choose_picture(inout Splat splat) {
  splat.picture = 0;
  if (KIND_OF_LIGHT != OF_MASS) return;
  for (int p = 0; p + 1 < pictures; ++p) splat.picture += int(splat.size > fits[p].x);
  if (splat.picture == 0) return;
  vec4 fit = fits[splat.picture];
  float s = fit.y;
  splat.x = splat.x * s + fit.z;
  splat.y = splat.y * s + fit.z;
  splat.parallax *= s;
  splat.light *= s * s;
  splat.size = sqrt(splat.size * splat.size * s * s - spread);
}

// False where the camera does not see it.
bool project(uint i, out Splat splat) {
  vec3 at = vec3(column_of(0, i), column_of(1, i), column_of(2, i)) - camera.xyz;
  float depth = dot(at, forward.xyz);
  if (!(depth > forward.w)) return false;
  float nearness = orthographic_nearness > 0 ? orthographic_nearness : 1 / depth;
  splat.x = dot(at, right.xyz) * nearness * camera.w + right.w;
  splat.y = dot(at, down.xyz) * nearness * camera.w + down.w;
  float entry = clamp((1 / depth - first_w) * entries_per_w, 0.0, float(parallax_entries - 1));
  vec4 of_table = table_entry(int(entry));
  splat.parallax = of_table.x + fract(entry) * of_table.y;
  float log2_density = has(3) ? log2(max(column_of(3, i), 1.17549435e-38)) : 0;
  splat.size = size_of(i, log2_density, nearness);
  splat.light = KIND_OF_LIGHT == OF_MASS ? light_of_mass(i, log2_density, nearness)
                                         : light_of_look(i, log2_density, splat.size);
  choose_picture(splat);
  return true;
}

layout(std430, binding = 2) writeonly buffer Splats { vec4 splats[]; };  // place, parallax, size; light, kind
layout(std430, binding = 3) buffer Reaches { uint reaches[]; };          // of each kind: the largest, as its bits

void main() {
  uint i = gl_GlobalInvocationID.x;
  if (i >= uint(particles)) return;
  Splat splat;
  uint kind = no_kind;
  if (project(i, splat)) {
    float reach = reach_in_lists(splat.size);
    kind = uint(kind_of(splat.picture, max(max(abs(splat.light.r), abs(splat.light.g)), abs(splat.light.b)), reach));
    uint bits = floatBitsToUint(reach);
    if (reaches[kind] < bits) atomicMax(reaches[kind], bits);
  }
  splats[2 * i] = vec4(clamp(splat.x, -1e8, 1e8), clamp(splat.y, -1e8, 1e8), splat.parallax, splat.size);
  splats[2 * i + 1] = vec4(splat.light, uintBitsToFloat(kind));
}
