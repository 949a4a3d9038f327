// Splats in lists: one for each kind, range of parallaxes (or depth plane), band of two rows, and four columns of the
// central view. Lists of neighbouring columns follow each other in memory, so that they can be read as one list.

#include "wheatstone/gpu/views.glsl"
#include "wheatstone/multiview/splat_kinds.glsl"

const int band_rows = 2;
const int list_columns = 2;
const int most_pictures = 9;

const int into_views = 0, into_nearest_plane = 1, between_planes = 2;
const int writes_sums = 0, adds_sums = 1, writes_light = 2;

// `index`: compact number of the kind, -1 if no splat has it; the other fields are indexed by that number.
struct Kind {
  int index, first_list, brightness;
  float reach;
};

struct Picture {
  int rows, bands, lists_a_band, slabs;
  int left, width;
  float lists_left, first_parallax;
  float slab_parallax;
  int first_kind, end_kind;  // compact numbers of its kinds
};

// The members of struct ListWork in gpu_lists_internal.h.
layout(std140, binding = 0) uniform Work {
  int splats;   // how many are put into lists
  int targets;  // one of the three ways above
  // What is gathered: targets of a picture.
  int picture, first_target, end_target, base;
  int channels;
  int written;  // sums, additions to sums, or light
  Kind kinds[most_kinds];
  Picture pictures[most_pictures];
  vec4 views[most_views];  // the first number of each
};

int list_at(Picture here, float x) {
  return clamp(int(floor((x - here.lists_left) * (1.0 / list_columns))), 0, here.lists_a_band - 1);
}
