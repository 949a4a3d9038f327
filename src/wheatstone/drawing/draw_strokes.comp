#version 450

// A tile of one view: the segments of strokes in its band of rows, from the nearest stroke to the farthest, until no
// light comes through. The twin of rasterise_simd.cpp and finish_row_simd.cpp.

layout(local_size_x = 8, local_size_y = 8) in;

const int most_views = 64;
const uint at_a_time = 64;  // segments that a tile looks at: one an invocation
const float far_away = 1e30;
const float unknown = -1e30;
const float nothing_shown = 1e30;
const float dark = 1.0 / 1024;
const float least_gap_light = 1 - 1.0 / 64;

// As struct StrokeWork in draw_strokes_gpu.cpp has them.
layout(std430, binding = 0) readonly buffer Work {
  int width, height;
  int has_surfaces;
  int shows_behind;    // 0: nothing shows through thin paint
  int has_background;  // else the canvas is behind
  uint canvas;
  float bare_light, tolerance_px;
  float still_depth;  // and how cells are numbered
  int first_cell;
  uint cells_a_band;
  float view[most_views];
};
struct Stroke {
  float red, green, blue, opacity;
  float middle_px, rim_px;
  float first_view, last_view;
  int planned_in;  // 0: the reference view, 1: another that photographs show, 2: any other
};
layout(std430, binding = 1) readonly buffer Strokes { Stroke strokes[]; };
struct Segment {
  float x, y, dx, dy;
  float depth, depth_slope;  // of its ends: disparity, and the step to the other's; of a rigid stroke: as a row has it
  float reach;
  uint stroke;  // and whether it is rigid: its rows move as one
};
layout(std430, binding = 2) readonly buffer Segments { Segment segments[]; };
layout(std430, binding = 3) readonly buffer Cells { uint cell_first[]; };
layout(std430, binding = 4) readonly buffer InCells { uint in_cells[]; };  // segments; the highest bit: fills gaps
layout(std430, binding = 5) readonly buffer Planes { float planes[]; };
layout(std430, binding = 6) readonly buffer Behind { uint behind[]; };
layout(std430, binding = 7) buffer Pixels { uint pixels[]; };  // colour; 1 << 24: a gap, 2 << 24: bare

const uint highest_bit = 1u << 31;  // of Segment::stroke and of in_cells

// A segment as the view sees it. A rigid stroke's place and pixels are those of the central view, sheared.
struct Seen {
  float x, y, dx, dy;
  float by_length2;
  float shear;
  float depth, depth_along, depth_down;  // at its beginning, to its end, and for each row of the picture
  uint stroke;
  int kind;
};

// Of the segments at hand, those that reach the tile.
shared uint reaches[2];
shared Seen near[at_a_time];
shared uint open;

Seen seen(Segment of, float shift) {
  bool rigid = (of.stroke & highest_bit) != 0;
  Seen here;
  here.x = of.x - shift * of.depth;
  here.y = of.y;
  here.dx = rigid ? of.dx : of.dx - shift * of.depth_slope;
  here.dy = of.dy;
  float length2 = here.dx * here.dx + here.dy * here.dy;
  here.by_length2 = length2 > 0 ? 1 / length2 : 0;
  here.shear = rigid ? shift * of.depth_slope : 0;
  here.depth = of.depth;
  here.depth_along = rigid ? 0 : of.depth_slope;
  here.depth_down = rigid ? of.depth_slope : 0;
  here.stroke = of.stroke & ~highest_bit;
  return here;
}

bool reaches_tile(Seen here, float reach) {
  vec2 low = vec2(gl_WorkGroupID.xy * 8u);
  vec2 high = low + 8;
  float above = here.shear * low.y;
  float below = here.shear * high.y;
  low.x += min(above, below);
  high.x += max(above, below);
  vec2 from = vec2(here.x, here.y);
  vec2 along = vec2(here.dx, here.dy);
  vec2 to = from + along;
  if (any(greaterThan(min(from, to) - reach, high)) || any(lessThan(max(from, to) + reach, low))) return false;
  vec2 across = vec2(along.y, -along.x) * sqrt(here.by_length2);
  vec2 half_size = (high - low) / 2;
  return abs(dot(across, low + half_size - from)) <= reach + dot(abs(across), half_size);
}

// The list of a tile: its cell, which is as wide as 16 columns of the depth that stays where it is.
uint cell_of_tile(float shift) {
  int column = int(floor((float(gl_WorkGroupID.x * 8u) + shift * still_depth) / 16)) - first_cell;
  return gl_WorkGroupID.y * cells_a_band + uint(clamp(column, 0, int(cells_a_band) - 1));
}

// Below which disparity paint is hidden, as hiding.h says it: of strokes of the reference view, of other views that
// photographs show, of all others, and of those that fill gaps.
vec4 hidden_below(int x, int y, int v) {
  if (has_surfaces == 0) return vec4(unknown);
  int size = width * height;
  int at = v * 3 * size + y * width + x;
  float reference = planes[at];
  float photographed = planes[at + size];
  float nearest = planes[at + 2 * size];
  float below = nearest == unknown ? unknown : nearest - tolerance_px;
  return vec4(below, reference != unknown && nearest <= reference + tolerance_px ? nothing_shown : below,
              photographed != unknown && nearest <= photographed + tolerance_px ? nothing_shown : below,
              photographed == unknown ? nothing_shown : below);
}

struct Drawn {
  vec3 paint;
  float light;
};

void slide_under(inout Drawn drawn, uint number, float squared) {
  Stroke stroke = strokes[number];
  float cover = clamp((stroke.middle_px - sqrt(squared)) / stroke.rim_px + 0.5, 0.0, 1.0);
  float share = cover * stroke.opacity * drawn.light;
  drawn.paint += share * vec3(stroke.red, stroke.green, stroke.blue);
  drawn.light -= share;
}

uint finished(Drawn drawn, int at) {
  vec3 colour;
  if (shows_behind == 0) {
    colour = drawn.paint / max(1 - drawn.light, 1e-6);
  } else {
    uint under = has_background != 0 ? behind[at] : canvas;
    colour = drawn.paint + drawn.light * vec3(under & 255u, under >> 8 & 255u, under >> 16 & 255u);
  }
  uvec3 level = uvec3(clamp(colour, 0.0, 255.0) + 0.5);
  return level.r | level.g << 8 | level.b << 16 | uint(drawn.light >= least_gap_light) << 24 |
         uint(drawn.light > bare_light) << 25;
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
  Drawn drawn = Drawn(vec3(0), inside ? 1.0 : 0.0);

  uint number = ~0u;  // of the stroke at hand, and the squared distance to what is seen of it
  int kind = 0;
  float squared = far_away;
  uint cell = cell_of_tile(shift);
  uint end = cell_first[cell + 1];
  for (uint first = cell_first[cell]; first < end; first += at_a_time) {
    if (me < 2) reaches[me] = 0;
    if (me == 0) open = 0;
    barrier();
    if (drawn.light > dark) open = 1;
    Seen mine;
    bool is_near = false;
    if (first + me < end) {
      uint entry = in_cells[first + me];
      Segment segment = segments[entry & ~highest_bit];
      mine = seen(segment, shift);
      if (reaches_tile(mine, segment.reach)) {
        Stroke stroke = strokes[mine.stroke];
        is_near = shift >= stroke.first_view && shift <= stroke.last_view;
        mine.kind = (entry & highest_bit) != 0 ? 3 : stroke.planned_in;
      }
    }
    if (is_near) atomicOr(reaches[me / 32], 1u << (me % 32));
    barrier();
    if (open == 0) break;
    uint count = 0;
    uint place = 0;
    for (uint word = 0; word < 2; ++word) {
      if (word == me / 32) place = count + bitCount(reaches[word] & ((1u << (me % 32)) - 1));
      count += bitCount(reaches[word]);
    }
    if (is_near) near[place] = mine;
    barrier();
    if (drawn.light <= dark) continue;
    for (uint i = 0; i < count; ++i) {
      Seen here = near[i];
      if (here.stroke != number || here.kind != kind) {
        if (squared < far_away) slide_under(drawn, number, squared);
        squared = far_away;
        if (drawn.light <= dark) break;
        number = here.stroke;
        kind = here.kind;
      }
      vec2 from = middle - vec2(here.x - here.shear * middle.y, here.y);
      vec2 along = vec2(here.dx, here.dy);
      float t = clamp(dot(from, along) * here.by_length2, 0.0, 1.0);
      vec2 away = from - t * along;
      float distance2 = dot(away, away);
      float depth = here.depth + t * here.depth_along + middle.y * here.depth_down;
      if (distance2 < squared && depth >= below[kind]) squared = distance2;
    }
  }
  if (!inside) return;
  if (squared < far_away) slide_under(drawn, number, squared);
  int at = (v * height + y) * width + x;
  pixels[at] = finished(drawn, at);
}
