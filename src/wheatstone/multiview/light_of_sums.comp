#version 450

// Converts gathered values to light: sums in fixed point, the nearest discs as gather_splats.comp keeps them, or light
// that is added to other light.
// Variant: FROM=0
// Variant: FROM=1
// Variant: FROM=2
#define SUMS 0
#define NEAREST 1
#define LIGHT 2

layout(local_size_x = 64) in;

#include "wheatstone/multiview/splat_kinds.glsl"

layout(std430, binding = 0) readonly buffer Gathered { uint gathered[]; };
layout(std430, binding = 1) buffer Light { float light[]; };

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at >= light.length()) return;
  if (FROM == SUMS) light[at] = light_of(uvec2(gathered[2 * at], gathered[2 * at + 1]));
  if (FROM == NEAREST) light[at] = uintBitsToFloat(gathered[6 * (at / 3) + 2 + at % 3]);
  if (FROM == LIGHT) light[at] += uintBitsToFloat(gathered[at]);
}
