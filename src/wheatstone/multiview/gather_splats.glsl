// Two rows of four pixels of one target, which is a view or a depth plane: the splats of the lists that reach there,
// gathered in fixed point. Nothing is shared, so that nothing waits; and integers add alike in any order.

#include "wheatstone/multiview/gathered_lists.glsl"
#include "wheatstone/multiview/splat_weights.glsl"
#include "wheatstone/multiview/fixed_point.glsl"

layout(std430, binding = 2) buffer Sums { uint sums[]; };  // low and high words in turn, or light

// The sums of four columns of a row, in one channel: whole steps, and of mass what is left of them, since the faintest
// pixels tell a mean, too.
struct FourSums {
  uvec4 low, high;
  ivec4 now, rest;
};
const int most_rest_bits = 22;

void carry(inout FourSums sums_of, ivec4 steps, int shift) {
  uvec4 moved = uvec4(steps << (shift & 31));
  uvec4 to_low = shift < 32 ? moved : uvec4(0);
  sums_of.low += to_low;
  sums_of.high += uvec4(lessThan(sums_of.low, to_low));
  sums_of.high += shift < 32 ? uvec4((steps >> 1) >> (31 - (shift & 31))) : moved;
}

void carry(inout FourSums sums_of, int shift, int rest_bits) {
  carry(sums_of, sums_of.now, shift);
  sums_of.now = ivec4(0);
  if (KERNEL == LIGHT) return;
  carry(sums_of, sums_of.rest, shift - rest_bits);
  sums_of.rest = ivec4(0);
}

// Four splats at a time: what is carried from one to the next costs more than what is added.
void add(inout FourSums sums_of, vec4 a, vec4 b, vec4 c, vec4 d, vec4 light, float steps_of_rest) {
  a *= light.x;
  b *= light.y;
  c *= light.z;
  d *= light.w;
  ivec4 whole_a = ivec4(a), whole_b = ivec4(b), whole_c = ivec4(c), whole_d = ivec4(d);
  sums_of.now += (whole_a + whole_b) + (whole_c + whole_d);
  if (KERNEL == LIGHT) return;
  sums_of.rest += (ivec4((a - vec4(whole_a)) * steps_of_rest) + ivec4((b - vec4(whole_b)) * steps_of_rest)) +
                  (ivec4((c - vec4(whole_c)) * steps_of_rest) + ivec4((d - vec4(whole_d)) * steps_of_rest));
}

// One channel of two rows.
struct Channel {
  FourSums upper, lower;
};

// A splat as these pixels see it: what of its light each column gets, and its light in each row.
struct Spread {
  vec4 columns;
  vec3 upper, lower;
};

void add_channel(inout Channel channel, Spread a, Spread b, Spread c, Spread d, vec4 upper, vec4 lower,
                 float steps_of_rest) {
  add(channel.upper, a.columns, b.columns, c.columns, d.columns, upper, steps_of_rest);
  add(channel.lower, a.columns, b.columns, c.columns, d.columns, lower, steps_of_rest);
}

void carry(inout Channel channel, int shift, int rest_bits) {
  carry(channel.upper, shift, rest_bits);
  carry(channel.lower, shift, rest_bits);
}

void put_one(Picture here, int x, int at, uint low, uint high) {
  if (x >= here.width) return;
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

void put(Picture here, int x, int y, int target, int channel, FourSums sums_of) {
  int at = y < here.rows ? base + ((target * here.rows + y) * here.width + x) * CHANNELS + channel : 0;
  if (y >= here.rows) x = here.width;
  put_one(here, x, at, sums_of.low.x, sums_of.high.x);
  put_one(here, x + 1, at + CHANNELS, sums_of.low.y, sums_of.high.y);
  put_one(here, x + 2, at + 2 * CHANNELS, sums_of.low.z, sums_of.high.z);
  put_one(here, x + 3, at + 3 * CHANNELS, sums_of.low.w, sums_of.high.w);
}

void put(Picture here, int x, int y, int target, int number, Channel channel) {
  put(here, x, y, target, number, channel.upper);
  put(here, x, y + 1, target, number, channel.lower);
}

// Dark where the list has ended.
Spread spread(uint index, uint end, float first_x, float view_here) {
  int entry = int(min(index, end - 1));
  vec4 at = uintBitsToFloat(texelFetch(entries, 2 * entry));
  vec4 light = uintBitsToFloat(texelFetch(entries, 2 * entry + 1));
  uint rows = floatBitsToUint(light.a);
  vec2 row = CHANNELS == 2 ? light.ba : vec2(rows & 0xffffu, rows >> 16) * (1.0 / 65535);
  if (index >= end) row = vec2(0);
  return Spread(weights_from(first_x + 0.5 - (at.x + at.y * view_here), at.w, at.z), light.rgb * row.x,
                light.rgb * row.y);
}

void main() {
  Picture here = pictures[picture];
  int x = int(gl_GlobalInvocationID.x) * columns;
  int band = int(gl_GlobalInvocationID.y);
  int target = first_target + int(gl_GlobalInvocationID.z);
  float first_x = float(x + here.left);
  const FourSums nothing = FourSums(uvec4(0), uvec4(0), ivec4(0), ivec4(0));
  const Channel dark = Channel(nothing, nothing);
  Channel first = dark, second = dark, third = dark;
  float view_here = view_of(target);
  List list = before_lists(here, target);
  bool gathering = gathers(here, x, band);
  while (gathering && (list.at < list.end || !is_last(list, here))) {
    if (list.at >= list.end) list = next_list(list, here, view_here, target, band, first_x);
    int rest_bits = min(list.shift, most_rest_bits);
    float steps_of_rest = exp2(float(rest_bits));
    uint end = min(list.end, list.at + splats_at_once);
    for (uint at = list.at; at < end; at += 4) {
      Spread a = spread(at, end, first_x, view_here), b = spread(at + 1, end, first_x, view_here),
             c = spread(at + 2, end, first_x, view_here), d = spread(at + 3, end, first_x, view_here);
      add_channel(first, a, b, c, d, vec4(a.upper.r, b.upper.r, c.upper.r, d.upper.r),
                  vec4(a.lower.r, b.lower.r, c.lower.r, d.lower.r), steps_of_rest);
      add_channel(second, a, b, c, d, vec4(a.upper.g, b.upper.g, c.upper.g, d.upper.g),
                  vec4(a.lower.g, b.lower.g, c.lower.g, d.lower.g), steps_of_rest);
      if (CHANNELS == 3)
        add_channel(third, a, b, c, d, vec4(a.upper.b, b.upper.b, c.upper.b, d.upper.b),
                    vec4(a.lower.b, b.lower.b, c.lower.b, d.lower.b), steps_of_rest);
    }
    list.at = end;
    carry(first, list.shift, rest_bits);
    carry(second, list.shift, rest_bits);
    if (CHANNELS == 3) carry(third, list.shift, rest_bits);
  }
  put(here, x, band_rows * band, target, 0, first);
  put(here, x, band_rows * band, target, 1, second);
  if (CHANNELS == 3) put(here, x, band_rows * band, target, 2, third);
}
