#version 450

// Finishes one pixel of one view of a picture: adds the light of the picture of half the size to its own and, in the
// view's own picture, converts it to the colour that is shown. The twin of composite_simd.cpp. SHOWN says what becomes
// of the light: it stays as it is; the thesis's look, which has no smaller pictures; ramp, or mean; three channels.
// Variant: SHOWN=0
// Variant: SHOWN=1
// Variant: SHOWN=2
// Variant: SHOWN=3

layout(local_size_x = 64) in;

const int stretch_shift = 16;
const int stays_light = 0, as_look = 1, as_mass = 2, as_colours = 3;

// The members of struct FinishWork in gpu_finish.cpp.
layout(std140, binding = 0) uniform Work {
  int channels, width, rows, pad;
  int base;  // of the picture's light
  int smaller_width, smaller_rows;  // 0: there is no smaller picture
  int shows_mean;
  int hues, table_size, stretch_size, first_index;
  float exposure, scale, offset;
};
layout(std430, binding = 1) readonly buffer Own { float own[]; };
layout(std430, binding = 2) readonly buffer Smaller { float smaller[]; };
layout(std430, binding = 3) writeonly buffer Shown { uint shown[]; };  // colours, or light
layout(std430, binding = 4) readonly buffer Tables { int tables[]; };  // sRGB, stretch, linear stretch, colours

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

uint srgb_of(vec3 linear) { return srgb_of(linear.r) | srgb_of(linear.g) << 8 | srgb_of(linear.b) << 16; }

int stretch_index(float value) {
  return clamp((floatBitsToInt(max(value * scale + offset, 0.0)) >> stretch_shift) - first_index, 0, stretch_size - 1);
}

uint colour_of(vec3 sum) {
  if (SHOWN == as_look) {
    vec3 exposed = max(sum * exposure, 0.0);
    return srgb_of(exposed / (exposed + 1.0));
  }
  if (SHOWN == as_colours) {
    float most = max(max(sum.r, sum.g), sum.b);
    return srgb_of(sum * (intBitsToFloat(tables[table_size + stretch_size + stretch_index(most)]) / max(most, 1e-30)));
  }
  bool lit = sum.r > 1e-30;
  float mean = lit ? sum.g / sum.r : 0;
  int hue = int(roundEven(clamp(mean * float(hues - 1), 0.0, float(hues - 1))));
  int brightness = tables[table_size + stretch_index(shows_mean != 0 ? mean : sum.r)];
  uint colour = uint(tables[table_size + 2 * stretch_size + brightness + hue]);
  return lit ? colour : 0;
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  int pixel = (v * rows + y) * width + x;
  int at = pixel * channels;
  vec3 sum = vec3(own[base + at], own[base + at + 1], channels == 3 ? own[base + at + 2] : 0);
  if (SHOWN != as_look && smaller_width > 0) {
    ivec2 columns = neighbours(x), lines = neighbours(y);
    sum.r += enlarged(v, 0, columns, lines);
    sum.g += enlarged(v, 1, columns, lines);
    if (channels == 3) sum.b += enlarged(v, 2, columns, lines);
  }
  if (SHOWN == stays_light) {
    shown[at] = floatBitsToUint(sum.r);
    shown[at + 1] = floatBitsToUint(sum.g);
    if (channels == 3) shown[at + 2] = floatBitsToUint(sum.b);
  } else {
    shown[pixel] = colour_of(sum);
  }
}
