#version 450

// One splat is counted in every list that it belongs to.

#include "wheatstone/multiview/place_splat.glsl"

void main() {
  InLists splat;
  if (!lists_of(gl_GlobalInvocationID.x, splat)) return;
  int lists = lists_in_all(splat);
  for (int n = 0; n < lists; ++n) atomicAdd(ends[list_of(splat, band_and_slab(splat, n))], 1u);
}
