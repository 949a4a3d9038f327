#version 450

// Counts the flagged pixels of a view: gaps, bare pixels, and wanted pixels that were drawn. draw_strokes.comp and
// others set the flags.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Work { int width, height; };
layout(std430, binding = 1) readonly buffer Pixels { uint pixels[]; };
layout(std430, binding = 2) buffer Counts { uint counts[]; };  // three of each view

void main() {
  int y = int(gl_WorkGroupID.x);
  int v = int(gl_WorkGroupID.y);
  uvec3 count = uvec3(0);
  for (int first = 0; first < width; first += 64) {
    int x = first + int(gl_LocalInvocationID.x);
    uint flags = x < width ? pixels[(v * height + y) * width + x] >> 24 : 0;
    count += uvec3(flags & 1u, flags >> 1 & 1u, flags >> 2 & 1u);
  }
  for (int i = 0; i < 3; ++i)
    if (count[i] > 0) atomicAdd(counts[3 * v + i], count[i]);
}
