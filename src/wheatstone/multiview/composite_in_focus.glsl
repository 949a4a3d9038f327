// One pixel of one view of a picture, where the depth differs from place to place: the depth planes are added, each
// moved by its parallax times the gain of the pixel.

layout(local_size_x = 64) in;

#include "wheatstone/multiview/moved_planes.glsl"

// As Focus::gain_at.
float gain_at(vec2 at) {
  vec2 away = at - vec2(focus_x, focus_y);
  float inside = max(1 - dot(away, away) / (focus_radius * focus_radius), 0.0);
  return 1 + (focus_gain - 1) * inside * inside;
}

vec3 light_at(int row, int x) {
  uvec4 two = texel_at(row, x >> 1);
  uvec2 pixel = (x & 1) != 0 ? two.zw : two.xy;
  if (CHANNELS == 2) return vec3(uintBitsToFloat(pixel), 0);
  return uintBitsToFloat(uvec3(pixel.x << 10, (pixel.x >> 21 | (pixel.y & 0x3ffu) << 11) << 10, pixel.y & 0xfffffc00u) &
                         uvec3(0x7ffffc00u, 0x7ffffc00u, 0xfffffc00u));
}

void main() {
  int x = int(gl_GlobalInvocationID.x), y = int(gl_GlobalInvocationID.y), v = int(gl_GlobalInvocationID.z);
  if (x >= width) return;
  float moved = -views[v].x * gain_at(vec2(x, y) + 0.5);
  vec3 sum = vec3(0);
  for (int plane = first_plane; plane < end_plane; ++plane) {
    int whole;
    vec4 weights = weights_of(moved * (first_parallax + float(plane) * plane_spacing), whole);
    int row = base + (plane * rows + y) * texels_a_row;
    int first = x + whole - left;
    for (int tap = 0; tap < taps; ++tap) sum += weights[tap] * light_at(row, first + tap);
  }
  int at = ((v * rows + y) * width + x) * CHANNELS;
  for (int channel = 0; channel < CHANNELS; ++channel)
    light[at + channel] = sum[channel] + (again != 0 ? light[at + channel] : 0);
}
