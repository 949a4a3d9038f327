#version 450

// One pixel of one view of a picture: the depth planes, each moved by its parallax, are added. The twin of
// composite_simd.cpp.

layout(local_size_x = 64) in;

const int most_views = 64;

// As struct CompositeWork in gpu_finish_internal.h has them.
layout(std430, binding = 0) readonly buffer Work {
  int channels, width, rows;
  int left, plane_width;                 // of the planes' columns
  int first_plane, end_plane, base;      // those in the buffer, and where number 0 would be
  int taps;                              // 1: nearest; 2: linear; 4: cubic
  float first_parallax, plane_spacing;
  float view[most_views];
};
layout(std430, binding = 1) readonly buffer Planes { float planes[]; };
layout(std430, binding = 2) buffer Light { float light[]; };

// How far a plane moves: whole pixels, and the weights of the pixels around the rest.
vec4 weights_of(float pixels, out int whole) {
  if (taps == 1) {
    whole = int(floor(pixels + 0.5));
    return vec4(1, 0, 0, 0);
  }
  whole = int(floor(pixels));
  float f = pixels - floor(pixels);
  if (taps == 2) return vec4(1 - f, f, 0, 0);
  // Keys 1981, a = −1/2.
  whole -= 1;
  return vec4(((-0.5 * f + 1) * f - 0.5) * f, (1.5 * f - 2.5) * f * f + 1, ((-1.5 * f + 2) * f + 0.5) * f,
              (0.5 * f - 0.5) * f * f);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  vec3 sum = vec3(0);
  for (int plane = first_plane; plane < end_plane; ++plane) {
    int whole;
    vec4 weights = weights_of(-view[v] * (first_parallax + float(plane) * plane_spacing), whole);
    int row = base + (plane * rows + y) * plane_width * channels;
    for (int tap = 0; tap < taps; ++tap) {
      int column = x + whole + tap - left;
      if (column < 0 || column >= plane_width) continue;
      int at = row + column * channels;
      sum += weights[tap] * vec3(planes[at], planes[at + 1], channels == 3 ? planes[at + 2] : 0);
    }
  }
  int pixel = ((v * rows + y) * width + x) * channels;
  for (int channel = 0; channel < channels; ++channel) light[pixel + channel] += sum[channel];
}
