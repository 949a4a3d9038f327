// The lists that two rows of four pixels of a target gather.

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/multiview/splat_lists.glsl"

layout(binding = 0) uniform usamplerBuffer entries;
layout(binding = 1) uniform usamplerBuffer ends;  // four lists a texel

const int columns = 4;
// A slab's limits are kept to by rounding alone.
const float safe_px = 0.0625;

// A list that is gathered: what is left of it, and which one it is.
struct List {
  uint at, end;
  int shift;  // of its steps
  int kind, slab;
};

// Before the first of those that a target gathers.
List before_lists(Picture here, int target) {
  return List(0, 0, 0, here.first_kind - 1, targets == into_views ? 1 << 30 : target);
}

bool is_last(List list, Picture here) {
  return list.kind + 1 >= here.end_kind && (targets != into_views || list.slab + 1 >= here.slabs);
}

uint end_of_list(int number) {
  uvec4 four = texelFetch(ends, number >> 2);
  uint of_two = (number & 1) != 0 ? four.y : four.x, of_others = (number & 1) != 0 ? four.w : four.z;
  return (number & 2) != 0 ? of_others : of_two;
}

// The entries of the next list that may reach these pixels: the slabs of a kind, one after the other.
List next_list(List list, Picture here, float view_here, int target, int band, float first_x) {
  if (targets != into_views || list.slab + 1 >= here.slabs) {
    ++list.kind;
    list.slab = targets == into_views ? 0 : target;
  } else {
    ++list.slab;
  }
  Kind kind = kinds[list.kind];
  float nearer = here.first_parallax + float(list.slab) * here.slab_parallax;
  vec2 moved = vec2(nearer, nearer + here.slab_parallax) * view_here;
  float around = kind.reach + safe_px;
  int in_band = kind.first_list + (list.slab * here.bands + band) * here.lists_a_band;
  int first = in_band + list_at(here, first_x + 0.5 - around - max(moved.x, moved.y));
  int last = in_band + list_at(here, first_x + float(columns) - 0.5 + around - min(moved.x, moved.y));
  list.at = first > 0 ? end_of_list(first - 1) : 0;
  list.end = end_of_list(last);
  list.shift = bits_a_brightness * kind.brightness;
  return list;
}

// Whether there is something to gather.
bool gathers(Picture here, int first_column, int band) { return first_column < here.width && band < here.bands; }

// By how much of its parallax a splat is moved to a target.
float view_of(int target) { return targets == into_views ? views[target].x : 0; }
