#version 450

// One splat is counted in every list that it stands in, and later written into each of them, in the steps that its light
// is counted in. CHANNELS and KERNEL say what it adds to a pixel.
// Variant: STEP=0
#define COUNTS 0
#define PLACES 1
#ifndef STEP
#define STEP PLACES
#endif

layout(local_size_x = 64) in;

#include "wheatstone/multiview/splat_lists.glsl"

layout(std430, binding = 1) buffer Ends { uint ends[]; };
layout(binding = 0) uniform usamplerBuffer splats_of;

struct InLists {
  vec4 at;     // place, parallax, size
  vec4 light;  // and kind
  int index, picture, first_band, end_band;
  int first_slab, end_slab;
  float rest;  // how far it lies beyond the first slab, of what two planes share
};

// False where it is in none.
bool lists_of(uint i, out InLists splat) {
  if (i >= uint(splats)) return false;
  splat.at = uintBitsToFloat(texelFetch(splats_of, int(2 * i)));
  splat.light = uintBitsToFloat(texelFetch(splats_of, int(2 * i + 1)));
  uint kind = floatBitsToUint(splat.light.w);
  if (kind == no_kind) return false;
  splat.index = kinds[kind].index;
  int p = int(kind) / kinds_a_picture;
  splat.picture = p;
  float reach = reach_in_lists(splat.at.w);
  int top = max(int(ceil(splat.at.y - reach - 0.5)), 0);
  int bottom = min(int(floor(splat.at.y + reach - 0.5)), pictures[p].rows - 1);
  splat.first_band = top / band_rows;
  splat.end_band = top > bottom ? splat.first_band : bottom / band_rows + 1;
  float at = clamp((splat.at.z - pictures[p].first_parallax) / pictures[p].slab_parallax, 0.0, float(pictures[p].slabs - 1));
  splat.rest = targets == between_planes ? fract(at) : 0;
  bool two = splat.rest > 0.25 && splat.rest < 0.75;
  splat.first_slab = int(targets == into_views || two ? floor(at) : roundEven(at));
  splat.end_slab = splat.first_slab + (two ? 2 : 1);
  if (!two) splat.rest = 0;
  return true;
}

int list_of(InLists splat, int slab, int band) {
  Picture here = pictures[splat.picture];
  return kinds[splat.index].first_list + (slab * here.bands + band) * here.lists_a_band + list_at(here, splat.at.x);
}

#if STEP == COUNTS

void take(InLists splat) {
  for (int slab = splat.first_slab; slab < splat.end_slab; ++slab)
    for (int band = splat.first_band; band < splat.end_band; ++band) atomicAdd(ends[list_of(splat, slab, band)], 1u);
}

#else

#include "wheatstone/multiview/splat_weights.glsl"

layout(std430, binding = 2) writeonly buffer Entries { vec4 entries[]; };

#if KERNEL == DISC

// As the processor keeps numbers (struct Splat), to the nearest half. packHalf2x16 may round otherwise.
vec2 halves(vec2 numbers) {
  const float least_normal = 1.0 / 16384, least_step = 1.0 / 16777216;
  uvec2 bits = floatBitsToUint(numbers);
  vec2 normal = uintBitsToFloat((bits + 0xfffu + (bits >> 13 & 1u)) & ~0x1fffu);
  return mix(normal, roundEven(numbers / least_step) * least_step, lessThan(abs(numbers), vec2(least_normal)));
}

// Its place, parallax and radius; its light, and what decides between two that are equally near.
void take(InLists splat) {
  vec2 red_green = halves(splat.light.rg);
  vec2 blue_size = halves(vec2(splat.light.b, splat.at.w));
  float rank = red_green.r + 2 * red_green.g + 4 * blue_size.x;
  for (int band = splat.first_band; band < splat.end_band; ++band) {
    uint entry = atomicAdd(ends[list_of(splat, splat.first_slab, band)], 1u);
    entries[2 * entry] = vec4(splat.at.x, splat.at.z, splat.at.y, max(blue_size.y / 2, least_radius));
    entries[2 * entry + 1] = vec4(red_green, blue_size.x, rank);
  }
}

#else

// Its place, parallax, scale and reach; its light, and the weights of the band's rows: two floats, or packed where
// light has three channels.
void take(InLists splat) {
  float reach = reach_of(splat.at.w);
  float scale = scale_of(splat.at.w);
  float steps = exp2(float(-least_step_exponent - bits_a_brightness * kinds[splat.index].brightness));
  vec3 light = clamp(splat.light.rgb * steps, -exp2(float(steps_a_splat_exponent)), exp2(float(steps_a_splat_exponent)));
  for (int slab = splat.first_slab; slab < splat.end_slab; ++slab) {
    float share = slab > splat.first_slab ? splat.rest : 1 - splat.rest;
    for (int band = splat.first_band; band < splat.end_band; ++band) {
      vec2 weights = weights_from(float(band * band_rows) + 0.5 - splat.at.y, reach, scale).xy;
      uint entry = atomicAdd(ends[list_of(splat, slab, band)], 1u);
      entries[2 * entry] = vec4(splat.at.x, splat.at.z, scale, reach);
      entries[2 * entry + 1] = CHANNELS == 2 ? vec4(light.rg * share, weights)
                                             : vec4(light * share, uintBitsToFloat(packUnorm2x16(weights)));
    }
  }
}

#endif
#endif

void main() {
  InLists splat;
  if (lists_of(gl_GlobalInvocationID.x, splat)) take(splat);
}
