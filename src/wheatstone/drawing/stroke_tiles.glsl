// Shared by programs that go through a tile's strokes from the nearest to the farthest. The including file declares
// `planes` and the members of the work that are used here.

const uint at_a_time = 64;  // segments that a tile looks at: one an invocation
const float far_away = 1e30;
const float unknown = -1e30;
const float nothing_shown = 1e30;
const uint highest_bit = 1u << 31;  // of entries of a cell: fills gaps

// The list of a tile: its cell, which is as wide as 16 columns of the depth that stays where it is.
uint cell_of_tile(uint first_column, uint band, float shift) {
  int column = int(floor((float(first_column) + shift * still_depth) / 16)) - first_cell;
  return band * cells_a_band + uint(clamp(column, 0, int(cells_a_band) - 1));
}

// The disparities below which paint is hidden, as in hiding.h: for strokes of the reference view, of other photographed
// views, of all other views, and for strokes that fill gaps.
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

// Whether paint that reaches this far around a segment reaches a rectangle; `by_length2`: 1 / (squared length of the
// segment), or 0.
bool reaches(vec2 from, vec2 along, float by_length2, float reach, vec2 low, vec2 high) {
  vec2 to = from + along;
  if (any(greaterThan(min(from, to) - reach, high)) || any(lessThan(max(from, to) + reach, low))) return false;
  vec2 across = vec2(along.y, -along.x) * sqrt(by_length2);
  vec2 half_size = (high - low) / 2;
  return abs(dot(across, low + half_size - from)) <= reach + dot(abs(across), half_size);
}

// The segments at hand that reach the tile: a bit each.
shared uint near_bits[2];

uint count_of_near() { return bitCount(near_bits[0]) + bitCount(near_bits[1]); }

// How many of them come before this invocation's.
uint place_among_near(uint me) {
  uint own = bitCount(near_bits[me / 32] & ((1u << (me % 32)) - 1));
  return me < 32 ? own : own + bitCount(near_bits[0]);
}
