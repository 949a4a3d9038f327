#version 450

// Two pixels of a depth plane become one texel of four words: two numbers of 32 bits for each
// pixel, or three of 21 bits, which are floats without a sign and with 13 bits of mantissa.

layout(local_size_x = 64) in;

// As struct PackWork in gpu_finish_internal.h has them.
layout(std140, binding = 0) uniform Work {
  int channels, width, rows;
  int texels_a_row;
  int first_value, first_texel;
};
layout(std430, binding = 1) readonly buffer Light { float light[]; };
layout(std430, binding = 2) writeonly buffer Texels { uvec4 texels[]; };

uvec2 pixel(int row, int x) {
  if (x >= width) return uvec2(0);
  int at = first_value + (row * width + x) * channels;
  float first = light[at], second = light[at + 1];
  if (channels == 2) return uvec2(floatBitsToUint(first), floatBitsToUint(second));
  const uint half_step = 1u << 9;
  uvec3 bits = (floatBitsToUint(max(vec3(first, second, light[at + 2]), 0.0)) + half_step) >> 10;
  return uvec2(bits.r | bits.g << 21, bits.g >> 11 | bits.b << 10);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.z) * rows + int(gl_GlobalInvocationID.y);
  if (x < texels_a_row) texels[first_texel + row * texels_a_row + x] = uvec4(pixel(row, 2 * x), pixel(row, 2 * x + 1));
}
