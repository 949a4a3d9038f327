#version 450

// One pixel of one view of a picture: its light, what the picture of half the size has there, and, of the view's own
// picture, the colour that it is shown in. The twin of composite_simd.cpp.

layout(local_size_x = 64) in;

const int stretch_shift = 16;

// As struct FinishWork in gpu_finish_internal.h has them.
layout(std430, binding = 0) readonly buffer Work {
  int channels, width, rows, pad;
  int base;  // of the picture's light
  int smaller_width, smaller_rows;  // 0: there is no smaller picture
  int shown;                        // 0: stays light; 1: the thesis's look; 2: ramp or column; 3: mean; 4: colours
  int hues, table_size, stretch_size, first_index;
  float exposure, scale, offset;
};
layout(std430, binding = 1) readonly buffer Own { float own[]; };
layout(std430, binding = 2) readonly buffer Smaller { float smaller[]; };
layout(std430, binding = 3) buffer Light { float light[]; };
layout(std430, binding = 4) buffer Colours { uint colours[]; };
layout(std430, binding = 5) readonly buffer Tables { int tables[]; };  // sRGB, stretch, linear stretch, colours

// The nearer and the farther pixel of the smaller picture, whose pad is 2, along one axis.
ivec2 neighbours(int at) {
  int from_pad = at - pad;
  int half_way = from_pad >> 1;
  return ivec2(half_way + 2, (from_pad & 1) != 0 ? half_way + 3 : half_way + 1);
}

float smaller_at(int v, int channel, int x, int y) {
  return smaller[((v * smaller_rows + y) * smaller_width + x) * channels + channel];
}

float enlarged(int v, int channel, ivec2 x, ivec2 y) {
  float near = 0.75 * smaller_at(v, channel, x.x, y.x) + 0.25 * smaller_at(v, channel, x.x, y.y);
  float far = 0.75 * smaller_at(v, channel, x.y, y.x) + 0.25 * smaller_at(v, channel, x.y, y.y);
  return 0.75 * near + 0.25 * far;
}

uint srgb_of(float linear) {
  return uint(tables[int(roundEven(clamp(linear, 0.0, 1.0) * float(table_size - 1)))]);
}

int stretch_index(float value) {
  return clamp((floatBitsToInt(max(value * scale + offset, 0.0)) >> stretch_shift) - first_index, 0, stretch_size - 1);
}

uint colour_of(vec3 sum) {
  if (shown == 1) {
    vec3 exposed = max(sum * exposure, 0.0);
    vec3 toned = exposed / (exposed + 1.0);
    return srgb_of(toned.r) | srgb_of(toned.g) << 8 | srgb_of(toned.b) << 16;
  }
  if (shown == 4) {
    float most = max(max(sum.r, sum.g), sum.b);
    vec3 toned = sum * (intBitsToFloat(tables[table_size + stretch_size + stretch_index(most)]) / max(most, 1e-30));
    return srgb_of(toned.r) | srgb_of(toned.g) << 8 | srgb_of(toned.b) << 16;
  }
  if (!(sum.r > 1e-30)) return 0u;
  float mean = sum.g / sum.r;
  int hue = int(roundEven(clamp(mean * float(hues - 1), 0.0, float(hues - 1))));
  int brightness = tables[table_size + stretch_index(shown == 3 ? mean : sum.r)];
  return uint(tables[table_size + 2 * stretch_size + brightness + hue]);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  int pixel = (v * rows + y) * width + x;
  vec3 sum = vec3(0);
  for (int channel = 0; channel < channels; ++channel) {
    sum[channel] = own[base + pixel * channels + channel];
    if (smaller_width > 0) sum[channel] += enlarged(v, channel, neighbours(x), neighbours(y));
    if (shown == 0) light[pixel * channels + channel] = sum[channel];
  }
  if (shown != 0) colours[pixel] = colour_of(sum);
}
