// One splat: the lists that it stands in.

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
