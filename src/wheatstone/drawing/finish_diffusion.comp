#version 450

// One pixel of one view: its colour; grey, and bare, where the view sees no line at all.

layout(local_size_x = 64) in;

const uint bare = 2u << 24;

layout(std430, binding = 0) readonly buffer Work { int width, height, coarse_width, coarse_height, odd, margin; };  // LevelWork
layout(std430, binding = 1) readonly buffer Colours { vec4 colours[]; };
layout(std430, binding = 2) readonly buffer Coarsest { vec4 coarsest[]; };  // a pixel a view
layout(std430, binding = 3) buffer Pixels { uint pixels[]; };

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  int seen_width = width - 2 * margin;
  if (x >= seen_width) return;
  int at = (v * height + y) * width + x + margin;
  uvec3 level = uvec3(clamp(colours[at].rgb, 0.0, 255.0) + 0.5);
  pixels[(v * height + y) * seen_width + x] = coarsest[v].a > 0 ? level.r | level.g << 8 | level.b << 16 : 0x808080u | bare;
}
