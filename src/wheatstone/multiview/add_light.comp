#version 450

// Light is added to other light.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer More { float more[]; };
layout(std430, binding = 1) buffer Light { float light[]; };

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at < light.length()) light[at] += more[at];
}
