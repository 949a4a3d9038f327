#version 450

// Two rows of four pixels of one view: the nearest of the discs in the lists that reach there. The twin of opaque.cpp.

#include "wheatstone/multiview/gathered_lists.glsl"

layout(std430, binding = 2) buffer Nearest { float nearest[]; };  // of a pixel: parallax, rank, light; or light alone

const float far_away = 3e38;

// Four pixels of a row.
struct Four {
  vec4 parallax, rank, red, green, blue;
};

// Of two that are equally near the brighter one is in front, whichever comes first.
void cover(inout Four four, vec4 at, vec4 light, vec4 away, float row_away) {
  float half_width = sqrt(max(at.w * at.w - row_away * row_away, 0));
  for (int i = 0; i < 4; ++i) {
    bool hits = abs(row_away) <= at.w && abs(away[i]) <= half_width;
    bool front = at.y < four.parallax[i] || (at.y == four.parallax[i] && light.a > four.rank[i]);
    if (!hits || !front) continue;
    four.parallax[i] = at.y;
    four.rank[i] = light.a;
    four.red[i] = light.r;
    four.green[i] = light.g;
    four.blue[i] = light.b;
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
