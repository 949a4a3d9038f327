#version 450

// The depth planes of a picture, each moved by its parallax, are added for every view. Before that, they are packed: two
// pixels of a plane become one texel of four words, which are two numbers of 32 bits for each pixel, or three of 21 bits:
// floats without a sign and with 13 bits of mantissa. The twin of composite_simd.cpp. CHANNELS are those of a pixel; at
// most TAPS pixels of a plane are read for one.
// Variant: STEP=0 CHANNELS=2
// Variant: STEP=0 CHANNELS=3
// Variant: STEP=1 CHANNELS=2 TAPS=2
// Variant: STEP=1 CHANNELS=2 TAPS=4
// Variant: STEP=1 CHANNELS=3 TAPS=2
// Variant: STEP=1 CHANNELS=3 TAPS=4
// Variant: STEP=2 CHANNELS=2
// Variant: STEP=2 CHANNELS=3
#define PACKS 0
#define MOVES 1           // eight pixels at a time
#define MOVES_IN_FOCUS 2  // one pixel at a time: depth differs from place to place

#if STEP == PACKS

layout(local_size_x = 64) in;

// The members of struct PackWork in gpu_finish.cpp.
layout(std140, binding = 0) uniform Work {
  int width, rows;
  int texels_a_row;
  int first_value, first_texel;
};
layout(std430, binding = 1) readonly buffer Light { float light[]; };
layout(std430, binding = 2) writeonly buffer Texels { uvec4 texels[]; };

uvec2 pixel(int row, int x) {
  if (x >= width) return uvec2(0);
  int at = first_value + (row * width + x) * CHANNELS;
  float first = light[at], second = light[at + 1];
  if (CHANNELS == 2) return uvec2(floatBitsToUint(first), floatBitsToUint(second));
  const uint half_step = 1u << 9;
  uvec3 bits = (floatBitsToUint(max(vec3(first, second, light[at + 2]), 0.0)) + half_step) >> 10;
  return uvec2(bits.r | bits.g << 21, bits.g >> 11 | bits.b << 10);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int row = int(gl_GlobalInvocationID.z) * rows + int(gl_GlobalInvocationID.y);
  if (x < texels_a_row) texels[first_texel + row * texels_a_row + x] = uvec4(pixel(row, 2 * x), pixel(row, 2 * x + 1));
}

#else

#include "wheatstone/gpu/views.glsl"

// The members of struct CompositeWork in gpu_finish.cpp.
layout(std140, binding = 0) uniform Work {
  int width, rows;
  int left, texels_a_row;            // of the planes' columns
  int first_plane, end_plane, base;  // those in the buffer, and where number 0 would be
  int taps;                          // 1: nearest; 2: linear; 4: cubic
  int again;                         // something was composited before
  float first_parallax, plane_spacing;
  float focus_x, focus_y, focus_radius, focus_gain;  // in this picture; as struct Focus has them
  vec4 views[most_views];  // the first number of each
};
layout(std430, binding = 1) buffer Light { float light[]; };
layout(binding = 0) uniform usamplerBuffer planes;

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

uvec4 texel_at(int row, int x) {
  bool there = x >= 0 && x < texels_a_row;
  uvec4 texel = texelFetch(planes, row + (there ? x : 0));
  return there ? texel : uvec4(0);
}

#if STEP == MOVES_IN_FOCUS

layout(local_size_x = 64) in;

// As Focus::gain_at.
float gain_at(vec2 at) {
  vec2 away = at - vec2(focus_x, focus_y);
  float inside = max(1 - dot(away, away) / (focus_radius * focus_radius), 0.0);
  return 1 + (focus_gain - 1) * inside * inside;
}

vec3 light_at(int row, int x) {
  uvec4 two = texel_at(row, x >> 1);
  uvec2 pixel = (x & 1) != 0 ? two.zw : two.xy;
  if (CHANNELS == 2) return vec3(uintBitsToFloat(pixel), 0);
  return uintBitsToFloat(uvec3(pixel.x << 10, (pixel.x >> 21 | (pixel.y & 0x3ffu) << 11) << 10, pixel.y & 0xfffffc00u) &
                         uvec3(0x7ffffc00u, 0x7ffffc00u, 0xfffffc00u));
}

void main() {
  int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y), v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  float moved = -views[v].x * gain_at(vec2(x, y) + 0.5);
  vec3 sum = vec3(0);
  for (int plane = first_plane; plane < end_plane; ++plane) {
    int whole;
    vec4 weights = weights_of(moved * (first_parallax + float(plane) * plane_spacing), whole);
    int row = base + (plane * rows + y) * texels_a_row;
    int first = x + whole - left;
    for (int tap = 0; tap < taps; ++tap) sum += weights[tap] * light_at(row, first + tap);
  }
  int at = ((v * rows + y) * width + x) * CHANNELS;
  for (int channel = 0; channel < CHANNELS; ++channel)
    light[at + channel] = sum[channel] + (again != 0 ? light[at + channel] : 0);
}

#else

layout(local_size_x = 8, local_size_y = 8) in;

const int columns = 8;

// A texel is two pixels: the channels of four pixels.
vec4 first_of(uvec4 a, uvec4 b) {
  uvec4 low = uvec4(a.xz, b.xz);
  return uintBitsToFloat(CHANNELS == 2 ? low : low << 11 >> 1);
}

vec4 second_of(uvec4 a, uvec4 b) {
  uvec4 low = uvec4(a.xz, b.xz), high = uvec4(a.yw, b.yw);
  return uintBitsToFloat(CHANNELS == 2 ? high : (low >> 21 | (high & 0x3ffu) << 11) << 10);
}

vec4 third_of(uvec4 a, uvec4 b) { return uintBitsToFloat(uvec4(a.yw, b.yw) & 0xfffffc00u); }

// The first pixel may be one too far to the left, which is half a texel: there is one weight more than taps.
vec4 filtered(vec4 here, vec4 next, vec4 weights, float last_weight) {
  vec4 sum = weights.x * here + weights.y * vec4(here.yzw, next.x) + weights.z * vec4(here.zw, next.xy);
  if (TAPS > 2) sum += weights.w * vec4(here.w, next.xyz) + last_weight * next;
  return sum;
}

void put_one(int at, int x, int channel, float light_here) {
  if (x >= width) return;
  at = at * CHANNELS + channel;
  light[at] = light_here + (again != 0 ? light[at] : 0);
}

void put(int at, int x, int channel, vec4 light_here) {
  put_one(at, x, channel, light_here.x);
  put_one(at + 1, x + 1, channel, light_here.y);
  put_one(at + 2, x + 2, channel, light_here.z);
  put_one(at + 3, x + 3, channel, light_here.w);
}

void main() {
  int x = int(gl_GlobalInvocationID.x) * columns;
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width || y >= rows) return;
  vec4 first_left = vec4(0), first_right = vec4(0), second_left = vec4(0), second_right = vec4(0), third_left = vec4(0),
       third_right = vec4(0);
  float view_here = views[v].x;
  for (int plane = first_plane; plane < end_plane; ++plane) {
    int whole;
    vec4 weights = weights_of(-view_here * (first_parallax + float(plane) * plane_spacing), whole);
    int first = x + whole - left;
    bool odd = (first & 1) != 0;
    float last_weight = odd ? weights.w : 0;
    if (odd) weights = vec4(0, weights.xyz);
    int texel = first >> 1;
    int row = base + (plane * rows + y) * texels_a_row;
    uvec4 a = texel_at(row, texel), b = texel_at(row, texel + 1), c = texel_at(row, texel + 2), d = texel_at(row, texel + 3),
          e = texel_at(row, texel + 4), f = TAPS > 2 ? texel_at(row, texel + 5) : uvec4(0);
    first_left += filtered(first_of(a, b), first_of(c, d), weights, last_weight);
    first_right += filtered(first_of(c, d), first_of(e, f), weights, last_weight);
    second_left += filtered(second_of(a, b), second_of(c, d), weights, last_weight);
    second_right += filtered(second_of(c, d), second_of(e, f), weights, last_weight);
    if (CHANNELS == 2) continue;
    third_left += filtered(third_of(a, b), third_of(c, d), weights, last_weight);
    third_right += filtered(third_of(c, d), third_of(e, f), weights, last_weight);
  }
  int at = (v * rows + y) * width + x;
  put(at, x, 0, first_left);
  put(at + 4, x + 4, 0, first_right);
  put(at, x, 1, second_left);
  put(at + 4, x + 4, 1, second_right);
  if (CHANNELS == 2) return;
  put(at, x, 2, third_left);
  put(at + 4, x + 4, 2, third_right);
}

#endif
#endif
