#version 450

// Two rows of four pixels of one target, which is a view or a depth plane: the splats of the lists that reach there.
// Nothing is shared, so that nothing waits. CHANNELS and KERNEL say what a splat adds to a pixel.

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/multiview/splat_lists.glsl"
#include "wheatstone/multiview/splat_weights.glsl"

layout(binding = 0) uniform usamplerBuffer entries;
layout(binding = 1) uniform usamplerBuffer ends;  // four lists a texel

const int columns = 4;
// A slab's limits are kept to by rounding alone.
const float safe_px = 0.0625;

// A list that is gathered: what is left of it, and which one it is.
struct List {
  uint at, end;
  int shift;  // of its steps
  int kind, slab;
};

// Before the first of those that a target gathers.
List before_lists(Picture here, int target) {
  return List(0, 0, 0, here.first_kind - 1, targets == into_views ? 1 << 30 : target);
}

bool is_last(List list, Picture here) {
  return list.kind + 1 >= here.end_kind && (targets != into_views || list.slab + 1 >= here.slabs);
}

uint end_of_list(int number) {
  uvec4 four = texelFetch(ends, number >> 2);
  uint of_two = (number & 1) != 0 ? four.y : four.x, of_others = (number & 1) != 0 ? four.w : four.z;
  return (number & 2) != 0 ? of_others : of_two;
}

// The entries of the next list that may reach these pixels: the slabs of a kind, one after the other.
List next_list(List list, Picture here, float view_here, int target, int band, float first_x) {
  if (targets != into_views || list.slab + 1 >= here.slabs) {
    ++list.kind;
    list.slab = targets == into_views ? 0 : target;
  } else {
    ++list.slab;
  }
  Kind kind = kinds[list.kind];
  float nearer = here.first_parallax + float(list.slab) * here.slab_parallax;
  vec2 moved = vec2(nearer, nearer + here.slab_parallax) * view_here;
  float around = kind.reach + safe_px;
  int in_band = kind.first_list + (list.slab * here.bands + band) * here.lists_a_band;
  int first = in_band + list_at(here, first_x + 0.5 - around - max(moved.x, moved.y));
  int last = in_band + list_at(here, first_x + float(columns) - 0.5 + around - min(moved.x, moved.y));
  list.at = first > 0 ? end_of_list(first - 1) : 0;
  list.end = end_of_list(last);
  list.shift = bits_a_brightness * kind.brightness;
  return list;
}

// Whether there is something to gather.
bool gathers(Picture here, int first_column, int band) { return first_column < here.width && band < here.bands; }

// By how much of its parallax a splat is moved to a target.
float view_of(int target) { return targets == into_views ? views[target].x : 0; }

#if KERNEL == DISC

// The nearest of the discs. The twin of opaque.cpp.

layout(std430, binding = 2) buffer Nearest { float nearest[]; };  // of a pixel: parallax, rank, light; or light alone

const float far_away = 3e38;

// Four pixels of a row.
struct Four {
  vec4 parallax, rank, red, green, blue;
};

// The twin of light_on_sphere in sphere_light_internal.h.
float light_on_sphere(vec2 place, float radius) {
  const float mean = 0.5736, flat_px = 1.5, round_px = 4;
  const vec3 lamp = vec3(-0.55, -0.7, -0.45) / 0.9975;
  float roundness = clamp((radius - flat_px) / (round_px - flat_px), 0, 1);
  float towards = sqrt(max(1 - dot(place, place), 0));
  float light = 0.13 + 0.25 * towards + 0.72 * max(dot(lamp, vec3(place, -towards)), 0);
  return 1 + roundness * (light / mean - 1);
}

// Of two equally near discs, the brighter one is in front, whatever their order.
void cover(inout Four four, vec4 at, vec4 light, vec4 away, float row_away) {
  float half_width = sqrt(max(at.w * at.w - row_away * row_away, 0));
  for (int i = 0; i < 4; ++i) {
    bool hits = abs(row_away) <= at.w && abs(away[i]) <= half_width;
    bool front = at.y < four.parallax[i] || (at.y == four.parallax[i] && light.a > four.rank[i]);
    if (!hits || !front) continue;
    four.parallax[i] = at.y;
    four.rank[i] = light.a;
    float share = light_on_sphere(vec2(away[i], row_away) / at.w, at.w);
    four.red[i] = light.r * share;
    four.green[i] = light.g * share;
    four.blue[i] = light.b * share;
  }
}

void put(Picture here, int x, int y, int target, Four four) {
  for (int i = 0; i < 4; ++i) {
    if (x + i >= here.width || y >= here.rows) continue;
    int pixel = base / 3 + (target * here.rows + y) * here.width + x + i;
    vec3 light = vec3(four.red[i], four.green[i], four.blue[i]);
    float parallax_here = four.parallax[i];
    if (written == writes_light) {
      nearest[3 * pixel] = light.r;
      nearest[3 * pixel + 1] = light.g;
      nearest[3 * pixel + 2] = light.b;
      continue;
    }
    int at = 6 * pixel;
    bool behind = written == adds_sums && (nearest[at] < parallax_here ||
                                           (nearest[at] == parallax_here && nearest[at + 1] >= four.rank[i]));
    if (behind) continue;
    nearest[at] = parallax_here;
    nearest[at + 1] = four.rank[i];
    nearest[at + 2] = light.r;
    nearest[at + 3] = light.g;
    nearest[at + 4] = light.b;
  }
}

void main() {
  Picture here = pictures[picture];
  int x = int(gl_GlobalInvocationID.x) * columns;
  int band = int(gl_GlobalInvocationID.y);
  int target = first_target + int(gl_GlobalInvocationID.z);
  float first_x = float(x + here.left);
  float view_here = view_of(target);
  const Four nothing = Four(vec4(far_away), vec4(-1), vec4(0), vec4(0), vec4(0));
  Four upper = nothing, lower = nothing;
  List list = before_lists(here, target);
  bool gathering = gathers(here, x, band);
  for (; gathering && (list.at < list.end || !is_last(list, here)); ++list.at) {
    if (list.at >= list.end) list = next_list(list, here, view_here, target, band, first_x);
    int entry = int(min(list.at, list.end));
    vec4 at = uintBitsToFloat(texelFetch(entries, 2 * entry));
    vec4 light = uintBitsToFloat(texelFetch(entries, 2 * entry + 1));
    if (list.at >= list.end) at.w = -1;
    vec4 away = vec4(0.5, 1.5, 2.5, 3.5) + first_x - (at.x + at.y * view_here);
    float row_away = float(band * band_rows) + 0.5 - at.z;
    cover(upper, at, light, away, row_away);
    cover(lower, at, light, away, row_away + 1);
  }
  put(here, x, band_rows * band, target, upper);
  put(here, x, band_rows * band + 1, target, lower);
}

#else

// Light is gathered in fixed point: integers add alike in any order.

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

#endif
