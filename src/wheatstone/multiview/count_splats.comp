#version 450

// One splat is counted in every list that it belongs to.

#include "wheatstone/multiview/place_splat.glsl"

void main() {
  InLists splat;
  if (!lists_of(gl_GlobalInvocationID.x, splat)) return;
  for (int slab = splat.first_slab; slab < splat.end_slab; ++slab)
    for (int band = splat.first_band; band < splat.end_band; ++band) atomicAdd(ends[list_of(splat, slab, band)], 1u);
}
