#version 450

// Draws a piece of a line in one view. The piece is sampled several times per pixel, and each sample adds its colour to
// the four pixels around it. The first pass finds the disparity of the nearest sample, the second sums the samples on
// its surface. The twin of draw_lines in draw_diffusion.cpp.

layout(local_size_x = 64) in;

#include "wheatstone/gpu/views.glsl"

const float unknown = -1e30;
const float same_surface_px = 1;

// The members of struct LineWork in draw_diffusion_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work {
  int width, height, margin, pieces;
  int adds;  // 0: the nearest; 1: the sums
  int has_surfaces;
  float first_photographed, last_photographed, tolerance_px;
  float view[most_views];
};
struct Piece {
  float ax, ay, a_disparity, bx, by, b_disparity;
  float a_red, a_green, a_blue, b_red, b_green, b_blue;
  float reference_view, first_view, last_view;
  float a_overhang_px, b_overhang_px;
  int is_continued, is_dot;
};
layout(std430, binding = 1) readonly buffer Pieces { Piece piece[]; };
layout(std430, binding = 2) readonly buffer Planes { float planes[]; };
layout(std430, binding = 3) buffer Nearest { uint nearest[]; };  // disparities, whose order integers keep
layout(std430, binding = 4) buffer Sums { uint sums[]; };        // red, green, blue, weight, in steps of 2^-12

uint ordered(float disparity) {
  uint bits = floatBitsToUint(disparity);
  return (bits & 0x80000000u) != 0 ? ~bits : bits | 0x80000000u;
}

float disparity_of(uint in_order) {
  return uintBitsToFloat((in_order & 0x80000000u) != 0 ? in_order & 0x7fffffffu : ~in_order);
}

bool hidden_at(float x, float y, float disparity, int v, bool gives_way) {
  int column = int(floor(x));
  int row = int(floor(y));
  if (column < 0 || row < 0 || column >= width || row >= height) return false;
  int at = (v * 3 * height + row) * width + column;
  float surface = planes[at + 2 * width * height];
  float photographed = planes[at + width * height];
  if (gives_way && photographed != unknown && surface <= photographed + tolerance_px) return true;
  return surface != unknown && disparity < surface - tolerance_px;
}

bool hidden(vec2 place, float disparity, int v, Piece of) {
  const float half_px = 0.5;
  if (has_surfaces == 0) return false;
  bool gives_way = of.is_continued != 0 && view[v] >= first_photographed && view[v] <= last_photographed;
  float offsets[4] = float[4](-half_px, half_px, of.a_overhang_px, of.b_overhang_px);
  for (int i = 0; i < 4; ++i)
    if (offsets[i] != 0 && !hidden_at(place.x + offsets[i], place.y, disparity, v, gives_way)) return false;
  return true;
}

void tell(int x, int y, int v, float share, float disparity, vec3 colour, float length_px) {
  const float least_share = 0.25;
  int wide = width + 2 * margin;
  x += margin;
  if (share <= 0 || x < 0 || y < 0 || x >= wide || y >= height) return;
  int at = (v * height + y) * wide + x;
  if (adds == 0) {
    if (share >= least_share) atomicMax(nearest[at], ordered(disparity));
    return;
  }
  if (nearest[at] != 0 && disparity < disparity_of(nearest[at]) - same_surface_px) return;
  uvec4 steps = uvec4(vec4(colour, 1) * (share * length_px * 4096) + 0.5);
  for (int c = 0; c < 4; ++c) atomicAdd(sums[4 * at + c], steps[c]);
}

void spread(vec2 place, int v, float disparity, vec3 colour, float length_px) {
  vec2 corner = place - 0.5;
  if (!(corner.x > -1 - margin && corner.y > -1 && corner.x < width + margin && corner.y < height)) return;
  ivec2 at = ivec2(floor(corner));
  vec2 part = corner - floor(corner);
  tell(at.x, at.y, v, (1 - part.x) * (1 - part.y), disparity, colour, length_px);
  tell(at.x + 1, at.y, v, part.x * (1 - part.y), disparity, colour, length_px);
  tell(at.x, at.y + 1, v, (1 - part.x) * part.y, disparity, colour, length_px);
  tell(at.x + 1, at.y + 1, v, part.x * part.y, disparity, colour, length_px);
}

void main() {
  const float steps_a_px = 2;
  const float longest_px = 8;
  const float most_stretched = 2.5;
  int number = int(gl_GlobalInvocationID.x);
  int v = int(gl_GlobalInvocationID.y);
  if (number >= pieces) return;
  Piece of = piece[number];
  if (view[v] < of.first_view || view[v] > of.last_view) return;
  float separation = view[v] - of.reference_view;
  vec3 a = vec3(of.ax - separation * of.a_disparity, of.ay, of.a_disparity);
  vec3 b = vec3(of.bx - separation * of.b_disparity, of.by, of.b_disparity);
  vec3 from = vec3(of.a_red, of.a_green, of.a_blue);
  vec3 to = vec3(of.b_red, of.b_green, of.b_blue);
  float length_px = distance(a.xy, b.xy);
  float planned = distance(vec2(of.ax, of.ay), vec2(of.bx, of.by));
  bool torn = length_px > max(longest_px, most_stretched * planned);
  int steps = torn ? 1 : max(int(ceil(length_px * steps_a_px)), 1);
  float step_px = torn || of.is_dot != 0 ? 1 : length_px / float(steps);
  for (int s = 0; s < steps; ++s) {
    float t = torn ? 0 : (float(s) + 0.5) / float(steps);
    vec3 place = a + t * (b - a);
    if (!hidden(place.xy, place.z, v, of)) spread(place.xy, v, place.z, from + t * (to - from), step_px);
  }
}
