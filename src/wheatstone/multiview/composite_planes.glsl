// Eight pixels of one view of a picture: the depth planes, each moved by its parallax, are added.

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/multiview/moved_planes.glsl"

const int columns = 8;

// A texel is two pixels (pack_planes.comp): the channels of four pixels.
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
