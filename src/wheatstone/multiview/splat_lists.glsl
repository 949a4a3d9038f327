// Splats in lists: one for each kind, range of parallaxes (or depth plane), band of two rows, and four columns of the
// central view. What comes one after the other lies beside each other, so that the lists of neighbouring columns are one.

#include "wheatstone/gpu/views.glsl"
#include "wheatstone/multiview/splat_kinds.glsl"

const int band_rows = 2;
const int list_columns = 4;
const int most_pictures = 9;

const int into_views = 0, into_nearest_plane = 1, between_planes = 2;
const int writes_sums = 0, adds_sums = 1, writes_light = 2;

// As struct ListWork in gpu_splats_internal.h has them.
layout(std430, binding = 0) readonly buffer Work {
  int splats;   // how many are put into lists
  int targets;  // one of the three ways above
  int by_mass;
  // What is gathered: targets of a picture, from kinds that are there.
  int picture, first_target, end_target, base;
  int channels, first_kind, end_kind;
  int written;  // what: sums, what is added to sums, or light
  int index_of[most_kinds];    // of a kind among those that are there; -1: none
  int first_list[most_kinds];  // by this index, as what follows
  int brightness[most_kinds];
  float reach[most_kinds];  // the largest
  // Of each picture.
  int rows[most_pictures], bands[most_pictures], lists_a_band[most_pictures], slabs[most_pictures];
  int left[most_pictures], width[most_pictures];
  float lists_left[most_pictures];
  float first_parallax[most_pictures], slab_parallax[most_pictures];
  float view[most_views];
};

int list_at(int p, float x) {
  return clamp(int(floor((x - lists_left[p]) * (1.0 / list_columns))), 0, lists_a_band[p] - 1);
}

int first_list_of(int index, int p, int slab, int band) {
  return first_list[index] + (slab * bands[p] + band) * lists_a_band[p];
}
