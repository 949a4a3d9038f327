// Which marks a view sees, as GLSL: src/wheatstone/drawing/hiding.h.

import { columnsASurface, unknown } from "./surfaces";

/** How a mark was planned, as far as surfaces hide it. */
export enum PlannedIn {
  reference = 0,
  photographed = 1, // another view that a photograph shows
  other = 2,
  gaps = 3, // no matter where: it fills what the reference view's marks leave bare
}

export const hidingRule = `
uniform sampler2D seen;     // of each pixel: nearest surface, the reference view's, the photographed one, its source
uniform vec2 seenScale;     // pixels of the surfaces for one that is drawn
uniform float tolerance;
const float unknown = ${unknown.toExponential()};
const float columnsASurface = ${columnsASurface.toFixed(1)};
const float anything = -1e30, nothing = 1e30;

vec4 surfacesAt(vec2 pixel) {
  return texelFetch(seen, min(ivec2(pixel * seenScale), textureSize(seen, 0) - 1), 0);
}
float leastSeen(float surface) { return surface == unknown ? anything : surface - tolerance; }
bool isOfReference(float surface, float reference) {
  return reference != unknown && surface <= reference + tolerance;
}
// The disparity that a mark must have to be seen.
float leastSeenOf(int plannedIn, vec4 surfaces) {
  if (plannedIn == ${PlannedIn.reference}) return leastSeen(surfaces.x);
  if (plannedIn == ${PlannedIn.gaps}) return surfaces.z == unknown ? nothing : leastSeen(surfaces.x);
  return isOfReference(surfaces.x, plannedIn == ${PlannedIn.photographed} ? surfaces.y : surfaces.z)
    ? nothing : leastSeen(surfaces.x);
}`;

/** What is bare takes the colour beside it on the farther surface. `drawn` is premultiplied by its alpha. */
export const gapRule = `
const int widestGap = 256;
bool isGap(sampler2D drawn, ivec2 at) { return texelFetch(drawn, at, 0).a <= 1.0 / 64.0; }
vec3 opaqueAt(sampler2D drawn, ivec2 at) {
  vec4 paint = texelFetch(drawn, at, 0);
  return paint.rgb / max(paint.a, 1e-4);
}
vec3 continued(sampler2D drawn, ivec2 at) {
  if (!isGap(drawn, at)) return opaqueAt(drawn, at);
  int width = textureSize(drawn, 0).x;
  ivec2 left = at, right = at;
  for (int i = 0; i < widestGap && left.x >= 0 && isGap(drawn, left); ++i) --left.x;
  for (int i = 0; i < widestGap && right.x < width && isGap(drawn, right); ++i) ++right.x;
  if (left.x < 0 && right.x >= width) return opaqueAt(drawn, at);
  bool fromLeft = right.x >= width;
  if (!fromLeft && left.x >= 0)
    fromLeft = max(surfacesAt(vec2(left) + 0.5).x, -1e3) <= max(surfacesAt(vec2(right) + 0.5).x, -1e3);
  return opaqueAt(drawn, fromLeft ? left : right);
}`;
