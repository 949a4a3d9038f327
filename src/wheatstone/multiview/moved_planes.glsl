// Depth planes of a picture, packed by pack_planes.comp, and how far they move. The twin of composite_simd.cpp.

#include "wheatstone/gpu/views.glsl"

// As struct CompositeWork in gpu_finish_internal.h has them.
layout(std140, binding = 0) uniform Work {
  int width, rows;
  int left, texels_a_row;            // of the planes' columns
  int first_plane, end_plane, base;  // those in the buffer, and where number 0 would be
  int taps;                          // 1: nearest; 2: linear; 4: cubic
  int again;                         // something was composited before
  float first_parallax, plane_spacing;
  float focus_x, focus_y, focus_radius, focus_gain;  // in this picture; as struct Focus has them
  vec4 views[most_views];  // the first number of each
};
layout(std430, binding = 1) buffer Light { float light[]; };
layout(binding = 0) uniform usamplerBuffer planes;

// How far a plane moves: whole pixels, and the weights of the pixels around the rest.
vec4 weights_of(float pixels, out int whole) {
  if (taps == 1) {
    whole = int(floor(pixels + 0.5));
    return vec4(1, 0, 0, 0);
  }
  whole = int(floor(pixels));
  float f = pixels - floor(pixels);
  if (taps == 2) return vec4(1 - f, f, 0, 0);
  // Keys 1981, a = −1/2.
  whole -= 1;
  return vec4(((-0.5 * f + 1) * f - 0.5) * f, (1.5 * f - 2.5) * f * f + 1, ((-1.5 * f + 2) * f + 0.5) * f,
              (0.5 * f - 0.5) * f * f);
}

uvec4 texel_at(int row, int x) {
  bool there = x >= 0 && x < texels_a_row;
  uvec4 texel = texelFetch(planes, row + (there ? x : 0));
  return there ? texel : uvec4(0);
}
