#version 450

// One row of one view: the painting's surfaces, warped to it. The twin of seen_surface.cpp and of depth/warp_row.h.

layout(local_size_x = 64) in;

#include "wheatstone/gpu/views.glsl"

const float unknown = -1e30;  // farther than anything
const float joined_px = 1;
const int widest_crack_px = 2;

// The members of struct SeeWork in seen_surface_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work {
  int width, height, parts;
  float view[most_views];
};
struct Part {
  float view;
  int left_px, continued, rows;
  uint first_row;  // in `first_runs`
};
layout(std430, binding = 1) readonly buffer Parts { Part part[]; };
layout(std430, binding = 2) readonly buffer FirstRuns { uint first_runs[]; };
struct Run {
  int begin, end;
  uint first_value;
};
layout(std430, binding = 3) readonly buffer Runs { Run runs[]; };
layout(std430, binding = 4) readonly buffer Disparities { float disparities[]; };
layout(std430, binding = 5) buffer Planes { float planes[]; };  // of each view: reference, photographed, nearest

int start_of(int v, int plane, int y) { return ((v * 3 + plane) * height + y) * width; }

void land(int row, int x, float disparity) {
  if (x >= 0 && x < width) planes[row + x] = max(planes[row + x], disparity);
}

void warp(Part from, int y, float separation, int row) {
  if (y >= from.rows) return;
  for (uint r = first_runs[from.first_row + y]; r < first_runs[from.first_row + y + 1]; ++r) {
    Run run = runs[r];
    float first_centre = float(from.left_px + run.begin) + 0.5;
    int count = run.end - run.begin;
    bool joined_before = false;
    float disparity = disparities[run.first_value];
    for (int x = 0; x < count; ++x) {
      float next_disparity = x + 1 < count ? disparities[run.first_value + x + 1] : unknown;
      bool joined_after = abs(next_disparity - disparity) <= joined_px;
      bool at_edge = !(joined_before && joined_after);
      joined_before = joined_after;
      float here = float(x) + first_centre - separation * disparity;
      if (at_edge) land(row, int(floor(here)), disparity);
      if (joined_after) {
        float next = float(x + 1) + first_centre - separation * next_disparity;
        int last = int(floor(next - 0.5));
        for (int target = int(ceil(here - 0.5)); target <= last; ++target) {
          float t = next > here ? (float(target) + 0.5 - here) / (next - here) : 0;
          land(row, target, disparity + t * (next_disparity - disparity));
        }
      }
      disparity = next_disparity;
    }
  }
}

void close_cracks(int row) {
  for (int begin = 1; begin + 1 < width; ++begin) {
    if (planes[row + begin] != unknown || planes[row + begin - 1] == unknown) continue;
    int end = begin;
    while (end < width && planes[row + end] == unknown) ++end;
    if (end < width && end - begin <= widest_crack_px) {
      float farther = min(planes[row + begin - 1], planes[row + end]);
      for (int x = begin; x < end; ++x) planes[row + x] = farther;
    }
    begin = end;
  }
}

void main() {
  int y = int(gl_GlobalInvocationID.x);
  int v = int(gl_GlobalInvocationID.y);
  if (y >= height) return;
  int reference = start_of(v, 0, y);
  int photographed = start_of(v, 1, y);
  int nearest = start_of(v, 2, y);
  for (int x = 0; x < width; ++x) {
    planes[reference + x] = unknown;
    planes[nearest + x] = unknown;
  }
  warp(part[0], y, view[v] - part[0].view, reference);
  close_cracks(reference);
  for (int x = 0; x < width; ++x) planes[photographed + x] = planes[reference + x];
  for (int p = 1; p < parts; ++p)
    warp(part[p], y, view[v] - part[p].view, part[p].continued != 0 ? nearest : photographed);
  for (int x = 0; x < width; ++x)
    if (planes[photographed + x] != unknown) planes[nearest + x] = planes[photographed + x];
}
