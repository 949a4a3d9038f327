#version 450

// Sums in fixed point, as gather_splats.glsl makes them, become light.

layout(local_size_x = 64) in;

#include "wheatstone/multiview/fixed_point.glsl"

layout(std430, binding = 0) readonly buffer Sums { uvec2 sums[]; };
layout(std430, binding = 1) writeonly buffer Light { float light[]; };

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at < light.length()) light[at] = light_of(sums[at]);
}
