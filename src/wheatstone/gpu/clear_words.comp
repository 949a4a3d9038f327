#version 450

// Sets words of a buffer to 0.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Work { uint first, count; };
layout(std430, binding = 1) writeonly buffer Words { uint words[]; };

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at < count) words[first + at] = 0;
}
