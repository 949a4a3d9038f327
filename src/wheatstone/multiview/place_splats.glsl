// One splat is written into every list that it belongs to, in the steps that its light is counted in.

#include "wheatstone/multiview/place_splat.glsl"
#include "wheatstone/multiview/splat_weights.glsl"

// Its place, parallax, scale and reach; its light, and the weights of the band's rows: two floats, or packed where
// light has three channels.
layout(std430, binding = 2) writeonly buffer Entries { vec4 entries[]; };

void main() {
  InLists splat;
  if (!lists_of(gl_GlobalInvocationID.x, splat)) return;
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
