#version 450

// One opaque splat is written into every list that it belongs to.

#include "wheatstone/multiview/place_splat.glsl"

// Its place, parallax and radius; its light, and what decides between two that are equally near.
layout(std430, binding = 2) writeonly buffer Entries { vec4 entries[]; };

// As the processor keeps numbers (struct Splat).
vec2 halves(vec2 numbers) { return unpackHalf2x16(packHalf2x16(numbers)); }

void main() {
  InLists splat;
  if (!lists_of(gl_GlobalInvocationID.x, splat)) return;
  vec2 red_green = halves(splat.light.rg);
  vec2 blue_size = halves(vec2(splat.light.b, splat.at.w));
  float rank = red_green.r + 2 * red_green.g + 4 * blue_size.x;
  for (int band = splat.first_band; band < splat.end_band; ++band) {
    uint entry = atomicAdd(ends[list_of(splat, splat.first_slab, band)], 1u);
    entries[2 * entry] = vec4(splat.at.x, splat.at.z, splat.at.y, max(blue_size.y / 2, least_radius));
    entries[2 * entry + 1] = vec4(red_green, blue_size.x, rank);
  }
}
