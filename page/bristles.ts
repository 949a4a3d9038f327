// What bristles leave within a stroke: src/wheatstone/drawing/bristles_simd_internal.h.

/** The seed of a stroke's bristles, of 32 bits, from the stroke's number: hash_keys of src/wheatstone/random.h. */
export function seedOf(number: number): number {
  const golden = 0x9e3779b97f4a7c15n;
  let state = BigInt.asUintN(64, BigInt(number) + 2n * golden);
  state = BigInt.asUintN(64, (state ^ (state >> 30n)) * 0xbf58476d1ce4e5b9n);
  state = BigInt.asUintN(64, (state ^ (state >> 27n)) * 0x94d049bb133111ebn);
  return Number(BigInt.asUintN(32, state ^ (state >> 31n)));
}

/** The paint of one stroke from place to place, as GLSL. Lengths are in drawn pixels. */
export const bristlesRule = `
uniform float bristle;  // width that one leaves; 0: strokes have no bristles
uniform float streaks, ridge, dry;
flat in uint seed;
uniform bool hasPicture;           // the brush has one
uniform sampler2D brushPicture;    // its cover, with the stroke's length along x

struct Place {
  float distance;       // to the stroke's curve
  float along, across;  // from where it begins; to the right of its course positive
  float facing;         // how much of the light from the upper left meets what faces right of the course, -1..1
};
struct Paint {
  float cover;
  float share;  // of the colour's change, 0..1
  float tone;   // levels to be added to the colour
};

// A hash of a lattice point, 0..1.
float lattice(uint which, int point) {
  uint h = uint(point) * 0x9e3779b9u + (seed + which * 0x85ebca6bu);
  h = (h ^ (h >> 16)) * 0x7feb352du;
  h = (h ^ (h >> 15)) * 0x846ca68bu;
  return float((h ^ (h >> 16)) >> 8) / 16777216.0;
}

// Smooth noise between lattice points a unit apart; "which" tells several apart.
float noise(uint which, float place) {
  float cell = floor(place), part = place - cell;
  return mix(lattice(which, int(cell)), lattice(which, int(cell) + 1), part * part * (3.0 - 2.0 * part));
}

// How much of a stroke's paint the brush's picture takes away, 0..1.
float leftBare(Place place, float radius, float whole) {
  float level = clamp(round(log2(32.0 / radius)), 0.0, 4.0);
  float side = (seed & 1u) != 0u ? -0.5 : 0.5;
  vec2 share = vec2((place.along + radius) / (whole + 2.0 * radius), 0.5 + side * place.across / radius);
  return 1.0 - textureLod(brushPicture, share, level).r;
}

// Of a brush whose rim has this middle and width.
Paint paintAt(Place place, float middle, float rim, float strokeLength) {
  float radius = middle / 0.95, whole = max(strokeLength, 1e-3);
  float share = clamp(place.along / whole, 0.0, 1.0);
  float left = 1.0, pictured = 0.0;
  if (hasPicture && strokeLength > 2.0 * radius) {
    // Of a thin stroke the picture would leave holes as fine as its pixels.
    float shownOfPicture = clamp((radius - 1.0) / 2.0, 0.0, 1.0), bare = leftBare(place, radius, whole);
    pictured = shownOfPicture * streaks * (0.25 - bare);
    if (dry > 0.0) left = 1.0 - shownOfPicture * bare;
  }
  if (bristle == 0.0 && !hasPicture) return Paint(clamp((middle - place.distance) / rim + 0.5, 0.0, 1.0), share, 0.0);

  // A bundle of bristles leaves one streak of a wide brush. Streaks that are too fine for the pixels are filtered.
  float width = max(bristle, radius / 6.0);
  float shown = clamp((width - 0.6) / 0.9, 0.0, 1.0);
  float lane = place.across / width;
  float side = place.across > 0.0 ? 40.0 : 0.0;
  float inside = middle * (1.0 - 0.12 * shown * noise(1u, place.along / (1.2 * radius) + side)) - place.distance;
  float cover = inside / rim + 0.5;
  // Distance beyond the ends of the curve.
  float beyond = sqrt(max(place.distance * place.distance - place.across * place.across, 0.0));
  if (dry > 0.0 && strokeLength > 2.0 * radius) {
    float run = whole * (1.0 - dry * noise(2u, lane));
    cover = min(cover, 1.0 - (place.along - run) / (1.5 * width));
    // A stroke ends as flat as its brush, and each bristle at its own place.
    float reach = radius * (1.0 - shown * (0.3 + 0.5 * noise(5u, lane + (share > 0.5 ? 60.0 : 0.0))));
    cover = min(cover, 1.0 - (beyond - reach) / width);
  }
  float fine = noise(3u, lane) - 0.5;
  float broad = noise(4u, lane / 2.3 + place.along / (3.0 * radius)) - 0.5;
  float atRim = clamp(1.0 - inside / (1.2 * width), 0.0, 1.0);
  float beside = max(1.0 - 2.0 * beyond / radius, 0.0);
  float facing = place.across < 0.0 ? -place.facing : place.facing;
  float tone = pictured + shown * (streaks * (0.8 * fine + 0.6 * broad) + ridge * beside * atRim * facing);
  return Paint(left * clamp(cover, 0.0, 1.0), share, tone);
}`;
