#version 450

// The mean colour of the lines at each pixel, and its weight.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 1) buffer Known { vec4 known[]; };  // colour, weight

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at >= known.length()) return;
  vec4 sum = vec4(sums[4 * at], sums[4 * at + 1], sums[4 * at + 2], sums[4 * at + 3]);
  known[at] = sum.a > 0 ? vec4(sum.rgb / sum.a, min(sum.a / 4096, 1.0)) : vec4(0);
}
