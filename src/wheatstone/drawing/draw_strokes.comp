#version 450

// A tile of one view: the segments of strokes in its band of rows, from the nearest stroke to the farthest, until no
// light comes through. The twin of rasterise_simd.cpp and finish_row_simd.cpp. PAINT says what varies within a stroke.
// Variant: PAINT=0
// Variant: PAINT=1
// Variant: PAINT=2
#define EVEN 0
#define CHANGES 1  // its colour alone
#define BRISTLES 2

layout(local_size_x = 8, local_size_y = 8) in;

#include "wheatstone/gpu/views.glsl"

const float dark = 1.0 / 1024;
const float least_gap_light = 1 - 1.0 / 64;

// The members of struct StrokeWork in draw_strokes_gpu.cpp.
layout(std430, binding = 0) readonly buffer Work {
  int width, height;
  int has_surfaces;
  int shows_behind;    // 0: nothing shows through thin paint
  int has_background;  // else the canvas is behind
  int only_wanted;     // 1: only pixels that are wanted are drawn
  uint canvas;
  float bare_light, tolerance_px;
  float still_depth;  // and how cells are numbered
  int first_cell;
  uint cells_a_band;
  float streaks, ridge;  // of the brush
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
  // Disparity at its beginning, and its change to the end; of a rigid stroke: at row 0, and its change a row.
  float depth, depth_slope;
  float reach;
  uint stroke;  // the highest bit: rigid, the pixels of a row move as one
};
layout(std430, binding = 2) readonly buffer Segments { Segment segments[]; };
layout(std430, binding = 3) readonly buffer Cells { uint cell_first[]; };
layout(std430, binding = 4) readonly buffer InCells { uint in_cells[]; };  // segments; the highest bit: fills gaps
layout(std430, binding = 5) readonly buffer Planes { float planes[]; };
// The backgrounds; or a bit for each pixel that is wanted, rows of whole words.
layout(std430, binding = 6) readonly buffer Behind { uint behind[]; };
// Colour; 1 << 24: a gap, 2 << 24: bare, 4 << 24: drawn because it was wanted.
layout(std430, binding = 7) buffer Pixels { uint pixels[]; };

#include "wheatstone/drawing/stroke_tiles.glsl"

#if PAINT != EVEN
#include "wheatstone/drawing/bristles.glsl"
#endif

// A segment as the view sees it. A rigid stroke's place and pixels are those of the central view, sheared.
struct Seen {
  float x, y, dx, dy;
  float by_length2;
  float shear;
  float depth, depth_along, depth_down;  // at its beginning, to its end, and for each row of the picture
  uint stroke;  // the highest bits: which of hidden_below hides it
  uint segment;
};
const int kind_bit = 30;

// The segments at hand that reach the tile.
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

bool reaches_tile(Seen here, float reach, vec2 low, vec2 high) {
  float above = here.shear * low.y;
  float below = here.shear * high.y;
  low.x += min(above, below);
  high.x += max(above, below);
  return reaches(vec2(here.x, here.y), vec2(here.dx, here.dy), here.by_length2, reach, low, high);
}

struct Drawn {
  vec3 paint;
  float light;
};

// The segment of a stroke that is nearest to the pixel.
struct Nearest {
  float squared;      // distance
  vec2 from, to_end;  // from the segment's beginning to the pixel, and to the segment's end
  uint segment;
  bool is_seen;  // where it is nearest
};
const Nearest none = Nearest(far_away, vec2(0), vec2(0), 0, false);

void slide_under(inout Drawn drawn, uint of, Nearest nearest) {
  uint number = of & ~(3u << kind_bit);
  Stroke stroke = strokes[number];
  vec3 colour = vec3(stroke.red, stroke.green, stroke.blue);
#if PAINT == EVEN
  float cover = (stroke.middle_px - sqrt(nearest.squared)) / stroke.rim_px + 0.5;
#else
  Bristles bristles = bristles_of(number);
  Place place = place_on(nearest.segment, nearest.squared, nearest.from, nearest.to_end);
  Paint paint = paint_at(bristles, stroke.middle_px, stroke.rim_px, place);
  float cover = paint.cover;
  colour = clamp(colour + paint.share * bristles.change + paint.tone, 0.0, 255.0);
#endif
  float share = clamp(cover, 0.0, 1.0) * stroke.opacity * drawn.light;
  drawn.paint += share * colour;
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
         uint(drawn.light > bare_light) << 25 | uint(only_wanted) << 26;
}

// The wanted pixel of this number in a tile of 32 columns and 8 rows, or a place outside the picture if there are
// fewer; and the number of wanted pixels in the tile.
ivec3 wanted_pixel(ivec2 tile, int v, uint number) {
  int words_a_row = (width + 31) / 32;
  uint left = number;
  uint bits = 0;
  uint all = 0;
  int row = -1;
  for (int r = 0; r < 8; ++r) {
    uint word = tile.y + r < height ? behind[(v * height + tile.y + r) * words_a_row + tile.x / 32] : 0;
    uint count = bitCount(word);
    all += count;
    if (row < 0) {
      if (left < count) {
        row = r;
        bits = word;
      } else {
        left -= count;
      }
    }
  }
  int column = 0;
  for (int half_word = 16; half_word > 0; half_word /= 2) {
    uint before = bitCount(bits & ((1u << half_word) - 1));
    if (left >= before) {
      left -= before;
      bits >>= half_word;
      column += half_word;
    }
  }
  return ivec3(row < 0 ? ivec2(width, height) : tile + ivec2(column, row), all);
}

void main() {
  int x = int(gl_GlobalInvocationID.x);
  int y = int(gl_GlobalInvocationID.y);
  int v = int(gl_GlobalInvocationID.z);
  ivec2 tile = ivec2(gl_WorkGroupID.xy) * 8;
  ivec2 tile_size = ivec2(8);
  if (only_wanted != 0) {
    // Four groups share a larger tile, and each draws 64 of its wanted pixels: groups after the first often have
    // nothing to do.
    tile.x = int(gl_WorkGroupID.x / 4) * 32;
    tile_size.x = 32;
    uint before = gl_WorkGroupID.x % 4 * 64;
    ivec3 found = wanted_pixel(tile, v, before + gl_LocalInvocationIndex);
    if (found.z <= int(before)) return;
    x = found.x;
    y = found.y;
  }
  uint me = gl_LocalInvocationIndex;
  bool inside = x < width && y < height;
  float shift = view[v];
  vec2 middle = vec2(x, y) + 0.5;
  vec4 below = inside ? hidden_below(x, y, v) : vec4(nothing_shown);
  Drawn drawn = Drawn(vec3(0), inside ? 1.0 : 0.0);

  uint at_hand = ~0u;  // the stroke, as Seen has it
  Nearest nearest = none;
  uint cell = cell_of_tile(uint(tile.x), gl_WorkGroupID.y, shift);
  uint end = cell_first[cell + 1];
  for (uint first = cell_first[cell]; first < end; first += at_a_time) {
    if (me < 2) near_bits[me] = 0;
    if (me == 0) open = 0;
    barrier();
    if (drawn.light > dark) open = 1;
    Seen mine;
    bool is_near = false;
    if (first + me < end) {
      uint entry = in_cells[first + me];
      Segment segment = segments[entry & ~highest_bit];
      mine = seen(segment, shift);
      mine.segment = entry & ~highest_bit;
      if (reaches_tile(mine, segment.reach, vec2(tile), vec2(tile + tile_size))) {
        Stroke stroke = strokes[mine.stroke];
        is_near = shift >= stroke.first_view && shift <= stroke.last_view;
        mine.stroke |= ((entry & highest_bit) != 0 ? 3u : uint(stroke.planned_in)) << kind_bit;
      }
    }
    if (is_near) atomicOr(near_bits[me / 32], 1u << (me % 32));
    barrier();
    if (open == 0) break;
    uint count = count_of_near();
    if (is_near) near[place_among_near(me)] = mine;
    barrier();
    if (drawn.light <= dark) continue;
    for (uint i = 0; i < count;) {
      uint next = near[i].stroke;
      if (next != at_hand) {
        if (nearest.is_seen) slide_under(drawn, at_hand, nearest);
        nearest = none;
        if (drawn.light <= dark) break;
        at_hand = next;
      }
      float hidden = below[at_hand >> kind_bit];
      do {
        Seen here = near[i];
        vec2 from = middle - vec2(here.x - here.shear * middle.y, here.y);
        vec2 to_end = vec2(here.dx, here.dy);
        float t = clamp(dot(from, to_end) * here.by_length2, 0.0, 1.0);
        vec2 away = from - t * to_end;
        float squared = dot(away, away);
        float depth = here.depth + t * here.depth_along + middle.y * here.depth_down;
        if (squared < nearest.squared) nearest = Nearest(squared, from, to_end, here.segment, depth >= hidden);
        ++i;
      } while (i < count && near[i].stroke == at_hand);
    }
  }
  if (!inside) return;
  if (nearest.is_seen) slide_under(drawn, at_hand, nearest);
  int at = (v * height + y) * width + x;
  pixels[at] = finished(drawn, at);
}
