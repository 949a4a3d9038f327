#version 450

// Fills the unknown share of one pixel from the picture of half the size.

layout(local_size_x = 64) in;

layout(std430, binding = 0) readonly buffer Work { int width, height, coarse_width, coarse_height; };  // LevelWork
layout(std430, binding = 1) readonly buffer Lines { vec4 lines[]; };
layout(std430, binding = 2) readonly buffer Coarse { vec4 coarse[]; };
layout(std430, binding = 3) buffer Colours { vec4 colours[]; };

vec3 coarse_at(int v, int x, int y) { return coarse[(v * coarse_height + y) * coarse_width + x].rgb; }

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  int at = (v * height + y) * width + x;
  vec4 line = lines[at];
  vec2 place = clamp((vec2(x, y) + 0.5) / 2 - 0.5, vec2(0), vec2(coarse_width - 1, coarse_height - 1));
  ivec2 low = ivec2(place);
  ivec2 high = min(low + 1, ivec2(coarse_width - 1, coarse_height - 1));
  vec2 part = place - vec2(low);
  vec3 there = mix(mix(coarse_at(v, low.x, low.y), coarse_at(v, high.x, low.y), part.x),
                   mix(coarse_at(v, low.x, high.y), coarse_at(v, high.x, high.y), part.x), part.y);
  colours[at] = line.a >= 1 ? line : vec4(mix(there, line.rgb, line.a), line.a);
}
