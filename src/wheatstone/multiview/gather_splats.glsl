// Two rows of eight pixels of one target, which is a view or a depth plane: the splats of the lists that reach there,
// gathered in fixed point. Nothing is shared, so that nothing waits; and integers add alike in any order.

#include "wheatstone/multiview/gathered_lists.glsl"
#include "wheatstone/multiview/splat_weights.glsl"
#include "wheatstone/multiview/fixed_point.glsl"

layout(std430, binding = 2) buffer Sums { uint sums[]; };  // low and high words in turn, or light

// The sums of four columns of a row, in one channel: whole steps, and of mass what is left of them, since the faintest
// pixels tell a mean, too. There are no arrays of them: Mesa's llvmpipe 22 keeps these in memory.
struct FourSums {
  uvec4 low, high;
  ivec4 now, rest;
};
const int most_rest_bits = 24;

void carry(inout FourSums sums_of, ivec4 steps, int shift) {
  uvec4 moved = uvec4(steps << shift);
  sums_of.low += moved;
  sums_of.high += uvec4((steps >> 1) >> (31 - shift)) + uvec4(lessThan(sums_of.low, moved));
}

void carry(inout FourSums sums_of, int shift, int rest_bits) {
  carry(sums_of, sums_of.now, shift);
  sums_of.now = ivec4(0);
  if (!OF_MASS) return;
  carry(sums_of, sums_of.rest, shift - rest_bits);
  sums_of.rest = ivec4(0);
}

void add_light(inout FourSums sums_of, vec4 light, float steps_of_rest) {
  ivec4 whole = ivec4(light);
  sums_of.now += whole;
  if (OF_MASS) sums_of.rest += ivec4(roundEven((light - vec4(whole)) * steps_of_rest));
}

// One channel of two rows of eight pixels.
struct Channel {
  FourSums upper_left, upper_right, lower_left, lower_right;
};

void add_channel(inout Channel channel, float light, vec2 row, vec4 left_weights, vec4 right_weights, float steps_of_rest) {
  float upper = light * row.x, lower = light * row.y;
  add_light(channel.upper_left, left_weights * upper, steps_of_rest);
  add_light(channel.upper_right, right_weights * upper, steps_of_rest);
  add_light(channel.lower_left, left_weights * lower, steps_of_rest);
  add_light(channel.lower_right, right_weights * lower, steps_of_rest);
}

void carry(inout Channel channel, int shift, int rest_bits) {
  carry(channel.upper_left, shift, rest_bits);
  carry(channel.upper_right, shift, rest_bits);
  carry(channel.lower_left, shift, rest_bits);
  carry(channel.lower_right, shift, rest_bits);
}

void put_one(int x, int at, uint low, uint high) {
  if (x >= width[picture]) return;
  if (written == adds_sums) {
    uint before = sums[2 * at];
    low += before;
    high += sums[2 * at + 1] + uint(low < before);
  }
  if (written == writes_light) {
    sums[at] = floatBitsToUint(light_of(uvec2(low, high)));
  } else {
    sums[2 * at] = low;
    sums[2 * at + 1] = high;
  }
}

void put(int x, int y, int target, int channel, FourSums sums_of) {
  int at = y < rows[picture] ? base + ((target * rows[picture] + y) * width[picture] + x) * CHANNELS + channel : 0;
  if (y >= rows[picture]) x = width[picture];
  put_one(x, at, sums_of.low.x, sums_of.high.x);
  put_one(x + 1, at + CHANNELS, sums_of.low.y, sums_of.high.y);
  put_one(x + 2, at + 2 * CHANNELS, sums_of.low.z, sums_of.high.z);
  put_one(x + 3, at + 3 * CHANNELS, sums_of.low.w, sums_of.high.w);
}

void put(int x, int y, int target, int number, Channel channel) {
  put(x, y, target, number, channel.upper_left);
  put(x + 4, y, target, number, channel.upper_right);
  put(x, y + 1, target, number, channel.lower_left);
  put(x + 4, y + 1, target, number, channel.lower_right);
}

void main() {
  int x = int(gl_GlobalInvocationID.x) * columns;
  int band = int(gl_GlobalInvocationID.y);
  int target = first_target + int(gl_GlobalInvocationID.z);
  float first_x = float(x + left[picture]);
  const FourSums nothing = FourSums(uvec4(0), uvec4(0), ivec4(0), ivec4(0));
  const Channel dark = Channel(nothing, nothing, nothing, nothing);
  Channel first = dark, second = dark, third = dark;
  int lists = lists_to_gather(x, band);
  float view_here = targets == into_views ? view[target] : 0;
  List list = List(0, 0, 0);
  // One loop goes through all lists, and another through as many splats always: Mesa's llvmpipe 22 loses values where
  // nested loops end apart.
  for (int n = 0; list.at < list.end || n < lists;) {
    if (list.at >= list.end) {
      list = list_number(n, target, band, first_x);
      ++n;
    }
    int rest_bits = min(list.shift, most_rest_bits);
    float steps_of_rest = exp2(float(rest_bits));
    for (uint k = 0; k < splats_at_once; ++k) {
      int entry = int(min(list.at + k, list.end));
      vec4 at = uintBitsToFloat(texelFetch(entries, 2 * entry));
      vec4 light = uintBitsToFloat(texelFetch(entries, 2 * entry + 1));
      if (list.at + k >= list.end) at.w = -1;
      float from_first = first_x - at.y * view_here - at.x;
      vec4 away = vec4(0.5, 1.5, 2.5, 3.5) + from_first;
      vec4 left_weights = weights_at(away, at.w, at.z, OF_MASS);
      vec4 right_weights = weights_at(away + 4, at.w, at.z, OF_MASS);
      vec2 row = CHANNELS == 2 ? light.ba : unpackUnorm2x16(floatBitsToUint(light.a));
      add_channel(first, light.r, row, left_weights, right_weights, steps_of_rest);
      add_channel(second, light.g, row, left_weights, right_weights, steps_of_rest);
      if (CHANNELS == 3) add_channel(third, light.b, row, left_weights, right_weights, steps_of_rest);
    }
    list.at += splats_at_once;
    carry(first, list.shift, rest_bits);
    carry(second, list.shift, rest_bits);
    if (CHANNELS == 3) carry(third, list.shift, rest_bits);
  }
  put(x, band_rows * band, target, 0, first);
  put(x, band_rows * band, target, 1, second);
  if (CHANNELS == 3) put(x, band_rows * band, target, 2, third);
}
