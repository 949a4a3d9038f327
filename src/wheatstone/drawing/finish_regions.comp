#version 450

// One row of one view: the mean of each pixel's samples; gaps take the colour of their farther neighbour. The twin of
// draw_regions.cpp.

layout(local_size_x = 64) in;

const int samples = 4;
const uint nothing = 0x7fffffffu;
const uint bare = 2u << 24;

layout(std430, binding = 0) readonly buffer Work { int width, height, first_row, rows; };  // the first of RegionWork
struct Mark {
  uint colour;
  float reference_view, first_view, last_view;
  int is_own;
};
layout(std430, binding = 1) readonly buffer Marks { Mark marks[]; };
layout(std430, binding = 2) readonly buffer Disparities { float disparities[]; };
layout(std430, binding = 3) readonly buffer Shown { uint shown[]; };
layout(std430, binding = 4) buffer Pixels { uint pixels[]; };

struct Pixel {
  uint colour;
  int covered;
  float disparity;
};

Pixel pixel_of(int v, int row, int x) {
  uvec3 sum = uvec3(0);
  Pixel pixel = Pixel(0, 0, 0);
  for (int line = 0; line < samples; ++line)
    for (int i = 0; i < samples; ++i) {
      int at = ((v * rows + row) * samples + line) * width * samples + x * samples + i;
      uint mark = shown[at] & nothing;
      if (mark == nothing) continue;
      uint colour = marks[mark].colour;
      sum += uvec3(colour & 255u, colour >> 8 & 255u, colour >> 16 & 255u);
      pixel.disparity += disparities[at];
      ++pixel.covered;
    }
  if (pixel.covered == 0) return pixel;
  uvec3 mean = (sum + uint(pixel.covered / 2)) / uint(pixel.covered);
  pixel.colour = mean.r | mean.g << 8 | mean.b << 16;
  pixel.disparity /= float(pixel.covered);
  return pixel;
}

void main() {
  int row = int(gl_GlobalInvocationID.x);
  int v = int(gl_GlobalInvocationID.y);
  if (row >= rows) return;
  int to = (v * height + first_row + row) * width;
  Pixel before = Pixel(0, 0, 0);
  int gap = 0;  // where the pixels without paint begin
  for (int x = 0; x <= width; ++x) {
    Pixel here = Pixel(0, 0, 0);
    if (x < width) {
      here = pixel_of(v, row, x);
      if (here.covered == 0) continue;
    }
    bool from_right = before.covered == 0 || (here.covered > 0 && here.disparity < before.disparity);
    uint colour = from_right ? here.colour : before.colour;
    for (; gap < x; ++gap) pixels[to + gap] = colour | bare;
    if (x < width) pixels[to + x] = here.colour | (here.covered < samples * samples / 2 ? bare : 0u);
    gap = x + 1;
    before = here;
  }
}
