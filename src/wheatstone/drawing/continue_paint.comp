#version 450

// One row of one view: pixels without paint take the colour beside them on the farther surface. The twin of
// continue_paint in draw_strokes.cpp.

layout(local_size_x = 64) in;

#include "wheatstone/gpu/views.glsl"

const uint gap = 1u << 24;
const float unknown = -1e30;

layout(std430, binding = 0) readonly buffer Work { int width, height, has_surfaces; };  // the first of StrokeWork
layout(std430, binding = 1) readonly buffer Planes { float planes[]; };
layout(std430, binding = 2) buffer Pixels { uint pixels[]; };

void main() {
  int y = int(gl_GlobalInvocationID.x);
  int v = int(gl_GlobalInvocationID.y);
  if (y >= height) return;
  int row = (v * height + y) * width;
  int nearest = ((v * 3 + 2) * height + y) * width;
  for (int begin = 0; begin < width; ++begin) {
    if ((pixels[row + begin] & gap) == 0) continue;
    int end = begin;
    while (end < width && (pixels[row + end] & gap) != 0) ++end;
    float before = 0;
    float after = 0;
    if (has_surfaces != 0 && begin > 0 && planes[nearest + begin - 1] != unknown) before = planes[nearest + begin - 1];
    if (has_surfaces != 0 && end < width && planes[nearest + end] != unknown) after = planes[nearest + end];
    bool from_left = end == width || (begin > 0 && before <= after);
    if (begin > 0 || end < width) {
      uint colour = pixels[row + (from_left ? begin - 1 : end)] & 0xffffffu;
      for (int x = begin; x < end; ++x) pixels[row + x] = colour | (pixels[row + x] & 0xff000000u);
    }
    begin = end;
  }
}
