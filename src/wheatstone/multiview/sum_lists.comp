#version 450

// How many entries 64 lists have together.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Lists { uint lists[]; };
layout(std430, binding = 1) writeonly buffer Sums { uint sums[]; };

void main() {
  uint i = gl_GlobalInvocationID.x;
  uint sum = 0;
  for (uint k = 0; k < 64; ++k) sum += 64 * i + k < lists.length() ? lists[64 * i + k] : 0;
  if (i < sums.length()) sums[i] = sum;
}
