// The lists that two rows of eight pixels of a target gather.

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/multiview/splat_lists.glsl"

layout(std430, binding = 1) readonly buffer Ends { uint ends[]; };
layout(binding = 0) uniform usamplerBuffer entries;

const int columns = 8;
// A slab's limits are kept to by rounding alone.
const float safe_px = 0.0625;

struct List {
  uint at, end;
  int shift;  // of its steps
};

// The entries of one of the lists that may reach these pixels: number `n`.
List list_number(int n, int target, int band, float first_x) {
  int index = first_kind + (targets == into_views ? n / slabs[picture] : n);
  int slab = targets == into_views ? n % slabs[picture] : target;
  float nearer = first_parallax[picture] + float(slab) * slab_parallax[picture];
  vec2 moved = targets == into_views ? vec2(nearer, nearer + slab_parallax[picture]) * view[target] : vec2(0);
  float around = reach[index] + safe_px;
  int in_band = first_list_of(index, picture, slab, band);
  int first = in_band + list_at(picture, first_x + 0.5 - around - max(moved.x, moved.y));
  int last = in_band + list_at(picture, first_x + float(columns) - 0.5 + around - min(moved.x, moved.y));
  return List(first > 0 ? ends[first - 1] : 0, ends[last], bits_a_brightness * brightness[index]);
}

// How many, of all kinds that are there.
int lists_to_gather(int first_column, int band) {
  if (first_column >= width[picture] || band >= bands[picture]) return 0;
  return (end_kind - first_kind) * (targets == into_views ? slabs[picture] : 1);
}
