#version 450

// Four pixels of a picture for a display, whose bytes are three words, or a mark for each pixel that it shows. The twin
// of lenticular.cpp, quilt.cpp, anaglyph.cpp and of stereo/packed_pair.cpp.

layout(local_size_x = 64) in;

const int under_lenses = 0;
const int as_quilt = 1;
const int as_anaglyph = 2;
const int woven = 3;
const uint groups_a_row = 1024;

// As struct ComposeWork in compose_gpu.cpp has them.
layout(std430, binding = 0) readonly buffer Work {
  int kind;
  int width, height;            // of the picture
  int view_width, view_height;  // of a view
  int views;                    // of the picture
  int first_view, view_count;   // at hand
  int columns, rows;            // of a quilt
  int blue_first;
  int rows_differ, columns_differ, right_first;  // of what is woven
  int clips_eyes;                                // of an anaglyph: each eye's part is clipped before they are added
  int marks;                                     // 1: mark what is shown
};
layout(std430, binding = 1) readonly buffer Views { uint views_pixels[]; };
// Under lenses: the phase from a sub-pixel to the next, low and high; for each row its row of the views and its first
// sub-pixel's phase; for each column its column of the views. Of an anaglyph: light of the code values, thresholds of
// red, green and blue, and both matrices.
layout(std430, binding = 2) readonly buffer Table { uint table[]; };
layout(std430, binding = 3) buffer Picture { uint picture[]; };

uint view_pixel(int v, int x, int y) {
  return views_pixels[((v - first_view) * view_height + y) * view_width + x] & 0xffffffu;
}

// The view that a sub-pixel shows, from the upper half of its phase of 64 bits.
int view_under_lens(int x, int y, int channel) {
  uint from_left = uint(3 * x + (blue_first != 0 ? 2 - channel : channel));
  uint high, low, carry, view, rest;
  umulExtended(from_left, table[0], high, low);
  high += from_left * table[1];
  uaddCarry(low, table[2 + 3 * y + 1], carry);
  umulExtended(high + carry + table[2 + 3 * y + 2], uint(views), view, rest);
  return int(view);
}

ivec2 place_under_lens(int x, int y) { return ivec2(table[2 + 3 * height + x], table[2 + 3 * y]); }

uint seen_through_lens(int x, int y) {
  ivec2 at = place_under_lens(x, y);
  uint colour = 0;
  for (int channel = 0; channel < 3; ++channel) {
    int v = view_under_lens(x, y, channel);
    if (v >= first_view && v < first_view + view_count) colour |= view_pixel(v, at.x, at.y) & (0xffu << (8 * channel));
  }
  return colour;
}

uint of_quilt(int x, int y) {
  int v = (rows - 1 - y / view_height) * columns + x / view_width;
  return v >= first_view && v < first_view + view_count ? view_pixel(v, x % view_width, y % view_height) : 0;
}

uint of_woven(int x, int y) {
  int eye = (rows_differ * y + columns_differ * x + right_first) & 1;
  return view_pixel(eye, x, y);
}

float number_at(int place) { return uintBitsToFloat(table[place]); }

// A row of a matrix times a colour, rounded after each step as the processor does.
float row_times(int row, uint colour) {
  precise float red = number_at(row) * number_at(int(colour & 255u));
  precise float green = number_at(row + 1) * number_at(int(colour >> 8 & 255u));
  precise float blue = number_at(row + 2) * number_at(int(colour >> 16 & 255u));
  precise float two = red + green;
  precise float all = two + blue;
  return all;
}

uint of_anaglyph(int x, int y) {
  uint left = view_pixel(0, x, y);
  uint right = view_pixel(1, x, y);
  uint colour = 0;
  for (int channel = 0; channel < 3; ++channel) {
    int matrices = 256 + 3 * 255;
    float of_left = row_times(matrices + 3 * channel, left);
    float of_right = row_times(matrices + 9 + 3 * channel, right);
    if (clips_eyes != 0) {
      of_left = clamp(of_left, 0.0, 1.0);
      of_right = clamp(of_right, 0.0, 1.0);
    }
    precise float light = of_left + of_right;
    // How many thresholds lie at or below it.
    uint level = 0;
    for (uint step = 128; step > 0; step /= 2)
      if (light >= number_at(256 + 255 * channel + int(level + step) - 1)) level += step;
    colour |= level << (8 * channel);
  }
  return colour;
}

uint colour_at(int x, int y) {
  if (kind == under_lenses) return seen_through_lens(x, y);
  if (kind == as_quilt) return of_quilt(x, y);
  return kind == as_anaglyph ? of_anaglyph(x, y) : of_woven(x, y);
}

// Marks the pixels of the views that a pixel under lenses shows: a bit each, rows of whole words.
void mark(int x, int y) {
  ivec2 at = place_under_lens(x, y);
  int words_a_row = (view_width + 31) / 32;
  for (int channel = 0; channel < 3; ++channel) {
    int v = view_under_lens(x, y, channel);
    if (v >= first_view && v < first_view + view_count)
      atomicOr(picture[((v - first_view) * view_height + at.y) * words_a_row + at.x / 32], 1u << (at.x % 32));
  }
}

void main() {
  uint number = gl_WorkGroupID.y * groups_a_row + gl_WorkGroupID.x;
  int first = int(number * 64u + gl_LocalInvocationID.x) * 4;
  uint colours[4];
  for (int i = 0; i < 4; ++i) {
    int at = first + i;
    colours[i] = 0;
    if (at >= width * height) continue;
    if (marks != 0)
      mark(at % width, at / width);
    else
      colours[i] = colour_at(at % width, at / width);
  }
  if (marks != 0 || first >= width * height) return;
  int word = first / 4 * 3;
  picture[word] |= colours[0] | colours[1] << 24;
  picture[word + 1] |= colours[1] >> 8 | colours[2] << 16;
  picture[word + 2] |= colours[2] >> 16 | colours[3] << 8;
}
