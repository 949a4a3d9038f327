#version 450

// Sums in fixed point, as add_splats.comp makes them, become light.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Sums { uint sums[]; };
layout(std430, binding = 1) buffer Light { float light[]; };

void main() {
  uint at = gl_GlobalInvocationID.x + gl_GlobalInvocationID.y * gl_NumWorkGroups.x * gl_WorkGroupSize.x;
  if (at >= light.length()) return;
  uint low = sums[2 * at];
  uint high = sums[2 * at + 1];
  bool negative = (high & 0x80000000u) != 0;
  if (negative) {
    low = ~low + 1;
    high = ~high + uint(low == 0);
  }
  float value = (float(high) * 4294967296.0 + float(low)) / 268435456.0;
  light[at] = negative ? -value : value;
}
