#version 450

// A row of one view of which only some pixels were drawn. If one of them is a gap, the whole row is wanted, because the
// pixels beside it fill the gap; otherwise none of it is.

layout(local_size_x = 64) in;

const uint gap = 1u << 24;

layout(std430, binding = 0) readonly buffer Work { int width, height; };  // the first of StrokeWork
layout(std430, binding = 1) readonly buffer Pixels { uint pixels[]; };
layout(std430, binding = 2) buffer Wanted { uint wanted[]; };

void main() {
  int y = int(gl_GlobalInvocationID.x);
  int v = int(gl_GlobalInvocationID.y);
  if (y >= height) return;
  int row = v * height + y;
  uint found = 0;
  for (int x = 0; x < width; ++x) found |= pixels[row * width + x] & gap;
  int words_a_row = (width + 31) / 32;
  for (int i = 0; i < words_a_row; ++i) wanted[row * words_a_row + i] = found != 0 ? ~0u : 0u;
}
