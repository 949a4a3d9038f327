#version 450

// One line of samples of one view: the mark that each of them shows. The twin of draw_regions.cpp.

layout(local_size_x = 64) in;

#include "wheatstone/gpu/views.glsl"

const float unknown = -1e30;
const float infinity = 3e38;
const int samples = 4;  // a pixel's side
const float hides_px = 1;
const uint nothing = 0x7fffffffu;
const uint of_reference = 1u << 31;  // marks of other views only fill gaps

// The members of struct RegionWork in draw_regions_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work {
  int width, height, first_row, rows;  // of the picture, and those at hand
  int has_surfaces, rows_a_band;
  float tolerance_px;
  float view[most_views];
};
struct Mark {
  uint colour;
  float reference_view, first_view, last_view;
  int is_own;
};
layout(std430, binding = 1) readonly buffer Marks { Mark marks[]; };
// A mark's edges in a band of rows.
struct InBand {
  uint mark, first_edge, end_edge;
};
layout(std430, binding = 2) readonly buffer Bands { uint band_first[]; };
layout(std430, binding = 3) readonly buffer InBands { InBand in_bands[]; };
struct Edge {
  float x, y, disparity;  // of its upper end
  float dx, dy, disparity_step;
};
layout(std430, binding = 4) readonly buffer Edges { Edge edges[]; };
layout(std430, binding = 5) readonly buffer Planes { float planes[]; };
layout(std430, binding = 6) buffer Disparities { float disparities[]; };
layout(std430, binding = 7) buffer Shown { uint shown[]; };

// Borders are repeated, so that these loops have a constant length and are unrolled: they do not count to the 65 535
// iterations after which Mesa's llvmpipe 22 ends all loops of an invocation.
float farthest_about(int v, int x, int y) {
  float farthest = infinity;
  for (int down = -1; down <= 1; ++down)
    for (int right = -1; right <= 1; ++right) {
      int row = clamp(y + down, 0, height - 1);
      int column = clamp(x + right, 0, width - 1);
      farthest = min(farthest, planes[((v * 3 + 2) * height + row) * width + column]);
    }
  return farthest;
}

void hide(int v, int y, int line) {
  for (int x = 0; x < width; ++x) {
    float below = unknown;
    uint mark = nothing;
    if (has_surfaces != 0) {
      float farthest = farthest_about(v, x, y);
      if (farthest != unknown) below = farthest - tolerance_px + hides_px;
      float reference = planes[(v * 3 * height + y) * width + x];
      float nearest = planes[((v * 3 + 2) * height + y) * width + x];
      if (reference != unknown && nearest <= reference + tolerance_px) mark |= of_reference;
    }
    for (int i = 0; i < samples; ++i) {
      disparities[line + x * samples + i] = below;
      shown[line + x * samples + i] = mark;
    }
  }
}

int first_sample(float place) { return int(clamp(ceil(place * samples - 0.5), 0.0, float(width * samples))); }

void fill_between(vec2 from, vec2 to, uint number, bool is_own, int line) {
  float slope = to.x > from.x ? (to.y - from.y) / (to.x - from.x) : 0;
  int end = first_sample(to.x);
  for (int i = first_sample(from.x); i < end; ++i) {
    float disparity = from.y + slope * ((float(i) + 0.5) / samples - from.x);
    uint before = shown[line + i];
    if (disparity < disparities[line + i] - hides_px) continue;
    if (!is_own && (before & of_reference) != 0 && (before & nothing) != nothing) continue;
    disparities[line + i] = disparity;
    shown[line + i] = number | (before & of_reference);
  }
}

// The next place to the right at which an edge of a mark crosses the line, with its disparity: (x, disparity).
// `last`: the place and the edge of the one before.
bool next_crossing(InBand at, float middle, float separation, inout float last_x, inout uint last_edge,
                   out vec2 crossing) {
  float x = infinity;
  uint found = ~0u;
  for (uint e = at.first_edge; e < at.end_edge; ++e) {
    Edge edge = edges[e];
    // Samples' middles on the edge, its upper end included.
    if (middle < edge.y || middle >= edge.y + edge.dy) continue;
    float t = (middle - edge.y) / edge.dy;
    float disparity = edge.disparity + t * edge.disparity_step;
    float here = edge.x + t * edge.dx - separation * disparity;
    bool is_after = here > last_x || (here == last_x && e > last_edge);
    if (!is_after || here > x || (here == x && found != ~0u)) continue;
    x = here;
    found = e;
    crossing = vec2(here, disparity);
  }
  last_x = x;
  last_edge = found;
  return found != ~0u;
}

void main() {
  int line_of_rows = int(gl_GlobalInvocationID.x);
  int v = int(gl_GlobalInvocationID.y);
  if (line_of_rows >= rows * samples) return;
  int y = first_row + line_of_rows / samples;
  int line = (v * rows * samples + line_of_rows) * width * samples;
  float middle = (float(first_row * samples + line_of_rows) + 0.5) / samples;
  hide(v, y, line);
  int band = y / rows_a_band;
  for (uint i = band_first[band]; i < band_first[band + 1]; ++i) {
    InBand at = in_bands[i];
    Mark mark = marks[at.mark];
    if (view[v] < mark.first_view || view[v] > mark.last_view) continue;
    float separation = view[v] - mark.reference_view;
    float last_x = -infinity;
    uint last_edge = 0;
    vec2 from;
    vec2 to;
    while (next_crossing(at, middle, separation, last_x, last_edge, from) &&
           next_crossing(at, middle, separation, last_x, last_edge, to))
      fill_between(from, to, at.mark, mark.is_own != 0, line);
  }
}
