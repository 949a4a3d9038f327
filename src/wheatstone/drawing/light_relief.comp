#version 450

// A pixel of one view: its paint, lit. The twin of light_relief in relief.cpp.

layout(local_size_x = 64) in;

const vec3 lamp = vec3(-0.45, -0.55, 0.70);
const float darkest = 0.55;
const float brightest = 1.5;
const float gloss = 40;

// The first of ReliefWork in relief_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work {
  int width, height;
  int has_surfaces;
  float tolerance_px, bristle_px, depth_px;
};
layout(std430, binding = 1) readonly buffer Heights { float heights[]; };
layout(std430, binding = 2) buffer Pixels { uint pixels[]; };

float lit(uint level, float light) {
  float shine = gloss * max(light - 1.12, 0.0);
  return min(light * float(level & 255u) + shine, 255.0) + 0.5;
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  int above = (v * height + max(y - 1, 0)) * width;
  int here = (v * height + y) * width;
  int below = (v * height + min(y + 1, height - 1)) * width;
  float slope_x = depth_px * (heights[here + min(x + 1, width - 1)] - heights[here + max(x - 1, 0)]) / 2;
  float slope_y = depth_px * (heights[below + x] - heights[above + x]) / 2;
  if (slope_x == 0 && slope_y == 0) return;
  float to_lamp = (lamp.z - slope_x * lamp.x - slope_y * lamp.y) / sqrt(1 + slope_x * slope_x + slope_y * slope_y);
  float light = clamp(to_lamp / lamp.z, darkest, brightest);
  uint pixel = pixels[here + x];
  uvec3 level = uvec3(lit(pixel, light), lit(pixel >> 8, light), lit(pixel >> 16, light));
  pixels[here + x] = (pixel & 0xff000000u) | level.r | level.g << 8 | level.b << 16;
}
