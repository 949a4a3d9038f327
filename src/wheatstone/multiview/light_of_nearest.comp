#version 450

// The light of the nearest discs, as gather_opaque.comp keeps them.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Nearest { float nearest[]; };
layout(std430, binding = 1) writeonly buffer Light { float light[]; };

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at < light.length()) light[at] = nearest[6 * (at / 3) + 2 + at % 3];
}
