#version 450

// A tile of one view: the height of the paint of every pixel, by the bristles of the strokes in its band of rows, from
// the nearest stroke to the farthest, until nothing shows through. The twin of ReliefBand in relief.cpp.

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/gpu/views.glsl"

const float shows_through = 0.25;  // of what new paint levels
const float buried = 1.0 / 1024;
const float run_in_bristles = 5.625;

// The members of struct ReliefWork in relief_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work {
  int width, height;
  int has_surfaces;
  float tolerance_px, bristle_px, depth_px;
  float still_depth;  // and how cells are numbered
  int first_cell;
  uint cells_a_band;
  float view[most_views];
};
struct Stroke {
  uint seed_low, seed_high;  // the hash of its bristles' seed
  float radius_px, opacity;
  float middle_px, rim_px;
  float first_view, last_view;
  int planned_in;  // 0: the reference view, 1: another that photographs show, 2: any other
};
layout(std430, binding = 1) readonly buffer Strokes { Stroke strokes[]; };
struct Segment {
  float x, y, dx, dy;
  float depth, depth_step;                 // disparity of its beginning, and the step to its end
  float before, before_by, before_by_two;  // length of the spine before it: a polynomial of the view's place
  float reach;
  uint stroke;
};
layout(std430, binding = 2) readonly buffer Segments { Segment segments[]; };
layout(std430, binding = 3) readonly buffer Cells { uint cell_first[]; };
layout(std430, binding = 4) readonly buffer InCells { uint in_cells[]; };  // segments; the highest bit: fills gaps
layout(std430, binding = 5) readonly buffer Planes { float planes[]; };
layout(std430, binding = 6) buffer Heights { float heights[]; };

#include "wheatstone/drawing/stroke_tiles.glsl"

// A segment as the view sees it.
struct Seen {
  float x, y, dx, dy;
  float by_length2;
  float depth, depth_step;
  float before;
  uint stroke;
};

// The segments at hand that reach the tile.
shared Seen near[at_a_time];
shared uint open;

Seen seen(Segment of, float shift) {
  Seen here;
  here.x = of.x - shift * of.depth;
  here.y = of.y;
  here.dx = of.dx - shift * of.depth_step;
  here.dy = of.dy;
  float length2 = here.dx * here.dx + here.dy * here.dy;
  here.by_length2 = length2 > 0 ? 1 / length2 : 0;
  here.depth = of.depth;
  here.depth_step = of.depth_step;
  here.before = of.before + shift * (of.before_by + shift * of.before_by_two);
  here.stroke = of.stroke;
  return here;
}

bool reaches_tile(Seen here, float reach) {
  vec2 low = vec2(gl_WorkGroupID.xy * 8u);
  return reaches(vec2(here.x, here.y), vec2(here.dx, here.dy), here.by_length2, reach, low, low + 8);
}

// Numbers of 64 bits: the lower half, then the upper one.
uvec2 sum_of(uvec2 a, uvec2 b) {
  uint carry;
  uint low = uaddCarry(a.x, b.x, carry);
  return uvec2(low, a.y + b.y + carry);
}

uvec2 product_of(uvec2 a, uvec2 b) {
  uint high, low;
  umulExtended(a.x, b.x, high, low);
  return uvec2(low, high + a.x * b.y + a.y * b.x);
}

uvec2 folded(uvec2 a, int bits) { return a ^ uvec2(a.x >> bits | a.y << (32 - bits), a.y >> bits); }

// One more key into a hash: the twin of hash_keys in random.h.
uvec2 hashed(uvec2 state, uvec2 key) {
  state = sum_of(state, sum_of(key, uvec2(0x7F4A7C15u, 0x9E3779B9u)));
  state = product_of(folded(state, 30), uvec2(0x1CE4E5B9u, 0xBF58476Du));
  state = product_of(folded(state, 27), uvec2(0x133111EBu, 0x94D049BBu));
  return folded(state, 31);
}

uvec2 hashed(uvec2 state, float whole) {
  int key = int(whole);
  return hashed(state, uvec2(uint(key), key < 0 ? ~0u : 0u));
}

float unit_float(uvec2 hash) { return float(hash.y >> 8) / 16777216.0; }

// Smooth noise between lattice points a unit apart, of a hashed seed.
float smooth_noise(uvec2 seed, float place) {
  float cell = floor(place);
  float t = place - cell;
  return mix(unit_float(hashed(seed, cell)), unit_float(hashed(seed, cell + 1)), t * t * (3 - 2 * t));
}

struct Laid {
  float height;
  float shown;  // of the height of what is below
};

// Where a pixel lies on a stroke.
struct OnStroke {
  float squared, along, beside;
};

float bristle_height(Stroke stroke, OnStroke place) {
  uvec2 seed = uvec2(stroke.seed_low, stroke.seed_high);
  float lane = place.beside / bristle_px;
  float ridge = smooth_noise(seed, lane);
  uvec2 of_lane = hashed(uvec2(0x7F4A7C15u, 0x9E3779B9u), hashed(seed, floor(lane)));
  float along = smooth_noise(of_lane, place.along / (run_in_bristles * bristle_px));
  float to_rim = clamp(sqrt(place.squared) / stroke.radius_px, 0.0, 1.0);
  return (0.7 * ridge + 0.3 * along) * (1 - 0.35 * to_rim * to_rim);
}

void lay_under(inout Laid laid, uint number, OnStroke place) {
  Stroke stroke = strokes[number];
  float cover = stroke.opacity * clamp((stroke.middle_px - sqrt(place.squared)) / stroke.rim_px + 0.5, 0.0, 1.0);
  if (cover <= 0) return;
  laid.height += laid.shown * cover * bristle_height(stroke, place);
  laid.shown *= 1 - (1 - shows_through) * cover;
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  uint me = gl_LocalInvocationIndex;
  bool inside = x < width && y < height;
  float shift = view[v];
  vec2 middle = vec2(x, y) + 0.5;
  vec4 below = inside ? hidden_below(x, y, v) : vec4(nothing_shown);
  Laid laid = Laid(0, inside ? 1.0 : 0.0);

  uint number = ~0u;  // of the stroke at hand, and where on it the pixel is
  int kind = 0;
  OnStroke place = OnStroke(far_away, 0, 0);
  uint cell = cell_of_tile(gl_WorkGroupID.x * 8u, gl_WorkGroupID.y, shift);
  uint end = cell_first[cell + 1];
  for (uint first = cell_first[cell]; first < end; first += at_a_time) {
    if (me < 2) near_bits[me] = 0;
    if (me == 0) open = 0;
    barrier();
    if (laid.shown > buried) open = 1;
    Seen mine;
    bool is_near = false;
    if (first + me < end) {
      uint entry = in_cells[first + me];
      Segment segment = segments[entry & ~highest_bit];
      mine = seen(segment, shift);
      if ((entry & highest_bit) == 0 && reaches_tile(mine, segment.reach)) {
        Stroke stroke = strokes[mine.stroke];
        is_near = shift >= stroke.first_view && shift <= stroke.last_view;
      }
    }
    if (is_near) atomicOr(near_bits[me / 32], 1u << (me % 32));
    barrier();
    if (open == 0) break;
    uint count = count_of_near();
    if (is_near) near[place_among_near(me)] = mine;
    barrier();
    if (laid.shown <= buried) continue;
    for (uint i = 0; i < count; ++i) {
      Seen here = near[i];
      if (here.stroke != number) {
        if (place.squared < far_away) lay_under(laid, number, place);
        place.squared = far_away;
        if (laid.shown <= buried) break;
        number = here.stroke;
        kind = strokes[number].planned_in;
      }
      vec2 from = middle - vec2(here.x, here.y);
      vec2 along = vec2(here.dx, here.dy);
      float t = clamp(dot(from, along) * here.by_length2, 0.0, 1.0);
      vec2 away = from - t * along;
      float squared = dot(away, away);
      if (squared >= place.squared || here.depth + t * here.depth_step < below[kind]) continue;
      float by_length = sqrt(here.by_length2);
      bool is_dot = here.by_length2 == 0;
      float length = is_dot ? 0 : 1 / by_length;
      float beside = is_dot ? from.y : (from.x * along.y - from.y * along.x) * by_length;
      place = OnStroke(squared, here.before + t * length, beside);
    }
  }
  if (!inside) return;
  if (place.squared < far_away) lay_under(laid, number, place);
  heights[(v * height + y) * width + x] = laid.height;
}
