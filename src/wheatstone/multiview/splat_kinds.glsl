// Splats of a kind belong to the same picture, are about as wide and about as bright: their lists are gone through with
// one width of search, and their light is counted in one step.

const uint no_kind = 0xffffffffu;
const int widths = 3;
const int brightnesses = 8;
const int kinds_a_picture = widths * brightnesses;
const int most_kinds = 9 * kinds_a_picture;

// The darkest splats' light is counted in steps of 2^-28, as sums are, up to 2^22 of them, so that 256 splats fit in a
// word. Of brighter ones a step is 2^6 times as large, and so on, up to a light of 2^36.
const int least_step_exponent = -28;
const int steps_a_splat_exponent = 22;
const int bits_a_brightness = 6;
const uint splats_at_once = 256;

float reach_of(float size) { return size / 2 + 0.5; }

// An opaque disc is at least a pixel's width, so that some centre is met.
const float least_radius = 0.71;
float reach_in_lists(float size) { return max(reach_of(size), least_radius); }

int brightness_of(float light) {
  float exponent = log2(max(light, 1e-30)) - float(least_step_exponent + steps_a_splat_exponent);
  return clamp(int(ceil(exponent / bits_a_brightness)), 0, brightnesses - 1);
}

int kind_of(int picture, float light, float reach) {
  int width = int(reach > 1.5) + int(reach > 4.0);
  return picture * kinds_a_picture + brightness_of(light) * widths + width;
}

// A sum in fixed point, its low and its high word, as light.
float light_of(uvec2 sum) {
  bool negative = (sum.y & 0x80000000u) != 0;
  if (negative) {
    sum.x = ~sum.x + 1;
    sum.y = ~sum.y + uint(sum.x == 0);
  }
  float value = (float(sum.y) * 4294967296.0 + float(sum.x)) / 268435456.0;
  return negative ? -value : value;
}
