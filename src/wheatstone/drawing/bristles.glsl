// The paint of one stroke from place to place: the twin of bristles_simd_internal.h. The including file defines PAINT,
// and `streaks` and `ridge` as members of its work.

#include "wheatstone/drawing/bristle_noise.glsl"

layout(binding = 0) uniform usamplerBuffer strokes_bristles;    // two texels a stroke
layout(binding = 1) uniform usamplerBuffer places_of_segments;  // a texel each
layout(binding = 2) uniform usamplerBuffer brush_picture;       // bytes of class BrushPicture, 16 a texel

// The members of struct Bristles in painting_gpu_internal.h.
struct Bristles {
  vec3 change;
  float length_px, radius_px, width_px, dry_px;
  uint seed;
  bool has_picture;  // the brush's is stretched over the stroke
};

Bristles bristles_of(uint stroke) {
  vec4 colour = uintBitsToFloat(texelFetch(strokes_bristles, int(2 * stroke)));
  uvec4 brush = texelFetch(strokes_bristles, int(2 * stroke + 1));
  vec3 sizes = uintBitsToFloat(brush.xyz);
  return Bristles(colour.rgb, colour.w, sizes.x, abs(sizes.y), sizes.z, brush.w, sizes.y < 0);
}

// The place of a pixel on a stroke: its distance to the curve, and the values that DistanceBand keeps.
struct Place {
  float distance, along, across, facing;
};

// The place on a segment. `from`: from the segment's beginning to the pixel; `to_end`: from its beginning to its end.
Place place_on(uint segment, float squared, vec2 from, vec2 to_end) {
  const vec2 light = vec2(0.6, 0.8);
  vec4 of_segment = uintBitsToFloat(texelFetch(places_of_segments, int(segment)));  // begin, length, least, most
  float length2 = dot(to_end, to_end);
  float t = length2 > 0 ? dot(from, to_end) / length2 : 0;
  vec2 course = length2 > 0 ? to_end * inversesqrt(length2) : vec2(1, 0);
  return Place(sqrt(squared), of_segment.x + clamp(t, of_segment.z, of_segment.w) * of_segment.y,
               course.x * from.y - course.y * from.x, light.x * course.y - light.y * course.x);
}

struct Paint {
  float cover;  // of the brush; it continues below 0 and above 1
  float share;  // of the colour's change, 0..1
  float tone;   // levels to be added to the colour
};

#if PAINT == BRISTLES
// How much of a stroke's paint the brush's picture takes away, 0..1.
float left_bare(Bristles of, Place place) {
  int level = clamp(int(round(log2(32 / of.radius_px))), 0, 4);
  ivec2 size = ivec2(256, 64) >> level;
  const int firsts[5] = int[](0, 16384, 20480, 21504, 21760);
  float side = (of.seed & 1) != 0 ? -0.5 : 0.5;
  vec2 share = vec2((place.along + of.radius_px) / (of.length_px + 2 * of.radius_px),
                    0.5 + side * place.across / of.radius_px);
  vec2 at = clamp(share * size - 0.5, vec2(0), vec2(size - 1));
  ivec2 first = min(ivec2(at), size - 2);
  vec2 part = at - first;
  int byte = firsts[level] + first.y * size.x + first.x;
  float levels[4];
  for (int i = 0; i < 4; ++i) {
    int here = byte + (i & 1) + (i >> 1) * size.x;
    uint word = texelFetch(brush_picture, here >> 4)[here >> 2 & 3];
    levels[i] = float(word >> 8 * (here & 3) & 255) / 255;
  }
  return 1 - mix(mix(levels[0], levels[1], part.x), mix(levels[2], levels[3], part.x), part.y);
}
#endif

Paint paint_at(Bristles of, float middle_px, float rim_px, Place place) {
  float share = clamp(place.along / of.length_px, 0.0, 1.0);
#if PAINT != BRISTLES
  return Paint((middle_px - place.distance) / rim_px + 0.5, share, 0);
#else
  // Streaks that are too fine for the pixels of a view are filtered, so that they do not sparkle.
  float shown = clamp((of.width_px - 0.6) / 0.9, 0.0, 1.0);
  float ragged = shown * 0.12;
  float lane = place.across / of.width_px;
  // The rim is ragged: each side of the stroke has its own.
  float side = place.across > 0 ? 40 : 0;
  float rim_noise = noise(of.seed, 1, place.along / (1.2 * of.radius_px) + side);
  float inside = middle_px - ragged * middle_px * rim_noise - place.distance;
  float cover = inside / rim_px + 0.5;
  // Each bristle has paint for its own length.
  float run = of.length_px - of.dry_px * noise(of.seed, 2, lane);
  // Distance beyond the ends of the curve. A stroke ends as flat as its brush, and each bristle at its own place.
  float beyond = sqrt(max(place.distance * place.distance - place.across * place.across, 0));
  float reach = of.radius_px * (1 - shown * (0.3 + 0.5 * noise(of.seed, 5, lane + (share > 0.5 ? 60 : 0))));
  if (of.dry_px > 0)
    cover = min(cover, min(1 - (place.along - run) / (1.5 * of.width_px), 1 - (beyond - reach) / of.width_px));
  // Streaks along the stroke: fine ones that go through, and broader ones that come and go.
  float fine = noise(of.seed, 3, lane) - 0.5;
  float broad = noise(of.seed, 4, lane / 2.3 + place.along / (3 * of.radius_px)) - 0.5;
  // Paint stands up at the rim of both sides.
  float beside = max(1 - 2 * beyond / of.radius_px, 0);
  float to_rim = clamp(1 - inside / (1.2 * of.width_px), 0.0, 1.0);
  float facing = place.across < 0 ? -place.facing : place.facing;
  float tone = shown * (streaks * (0.8 * fine + 0.6 * broad) + ridge * beside * to_rim * facing);
  if (of.has_picture) {
    // On a thin stroke, the brush's picture would leave holes as small as a pixel.
    float pictured = clamp((of.radius_px - 1) / 2, 0.0, 1.0);
    float bare = left_bare(of, place);
    tone += pictured * streaks * (0.25 - bare);
    if (of.dry_px > 0) cover = min(cover, clamp(cover, 0.0, 1.0) * (1 - pictured * bare));
  }
  return Paint(cover, share, tone);
#endif
}
