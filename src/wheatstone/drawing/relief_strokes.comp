#version 450

// A tile of one view: the height of the paint of every pixel, by the bristles of the strokes in its band of rows, from
// the nearest stroke to the farthest, until nothing shows through. The twin of ReliefBand in relief.cpp.

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/drawing/bristle_noise.glsl"
#include "wheatstone/gpu/views.glsl"

const float shows_through = 0.25;  // of what new paint levels
const float buried = 1.0 / 1024;

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
  uint seed;  // of its bristles
  float radius_px, opacity;
  float middle_px, rim_px;
  float first_view, last_view;
  int planned_in;  // 0: the reference view, 1: another that photographs show, 2: any other
};
layout(std430, binding = 1) readonly buffer Strokes { Stroke strokes[]; };
struct Segment {
  float x, y, dx, dy;
  float depth, depth_step;   // disparity of its beginning, and the step to its end
  float begin_px, along_px;  // along the stroke, in the central view
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
  float begin_px, along_px;
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
  here.begin_px = of.begin_px;
  here.along_px = of.along_px;
  here.stroke = of.stroke;
  return here;
}

bool reaches_tile(Seen here, float reach) {
  vec2 low = vec2(gl_WorkGroupID.xy * 8u);
  return reaches(vec2(here.x, here.y), vec2(here.dx, here.dy), here.by_length2, reach, low, low + 8);
}

struct Laid {
  float height;
  float shown;  // of the height of what is below
};

// Where a pixel lies on a stroke.
struct OnStroke {
  float squared, along, across;
};

float bristle_height(Stroke stroke, OnStroke place) {
  float lane = place.across / max(bristle_px, stroke.radius_px / 6);
  float fine = noise(stroke.seed, 3, lane);
  float broad = noise(stroke.seed, 4, lane / 2.3 + place.along / (3 * stroke.radius_px));
  float to_rim = clamp(sqrt(place.squared) / stroke.radius_px, 0.0, 1.0);
  return (0.57 * fine + 0.43 * broad) * (1 - 0.35 * to_rim * to_rim);
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
      float across =
          here.by_length2 == 0 ? from.y : (along.x * from.y - along.y * from.x) * sqrt(here.by_length2);
      place = OnStroke(squared, here.begin_px + t * here.along_px, across);
    }
  }
  if (!inside) return;
  if (place.squared < far_away) lay_under(laid, number, place);
  heights[(v * height + y) * width + x] = laid.height;
}
