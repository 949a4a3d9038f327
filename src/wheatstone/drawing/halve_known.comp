#version 450

// Makes one pixel of the picture of half the size: the mean of its four pixels, by their weights.

layout(local_size_x = 64) in;

// The members of struct LevelWork in draw_diffusion_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work { int width, height, coarse_width, coarse_height; };
layout(std430, binding = 1) readonly buffer Fine { vec4 fine[]; };
layout(std430, binding = 2) buffer Coarse { vec4 coarse[]; };

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= coarse_width) return;
  vec4 sum = vec4(0);
  for (int i = 0; i < 4; ++i) {
    ivec2 at = ivec2(2 * x + (i & 1), 2 * y + (i >> 1));
    if (at.x >= width || at.y >= height) continue;
    vec4 part = fine[(v * height + at.y) * width + at.x];
    sum += vec4(part.rgb * part.a, part.a);
  }
  coarse[(v * coarse_height + y) * coarse_width + x] = sum.a > 0 ? vec4(sum.rgb / sum.a, min(sum.a, 1.0)) : vec4(0);
}
