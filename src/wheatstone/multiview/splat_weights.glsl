// How much of a splat's light pixels get, along one axis. The twin of deposit_simd.cpp. KERNEL says how it is spread.
// Variant: CHANNELS=2 KERNEL=1
// Variant: CHANNELS=2 KERNEL=2
// Variant: CHANNELS=3 KERNEL=0
// Variant: CHANNELS=3 KERNEL=1
// Variant: CHANNELS=3 KERNEL=2
// Variant: CHANNELS=3 KERNEL=3

#define LIGHT 0   // a Gaussian's value at the middle of a pixel
#define MASS 1    // the part of a Gaussian over the pixel: parts sum to 1
#define SPLINE 2  // the same of the cubic spline kernel
#define DISC 3    // an opaque disc, of which there is all or nothing

// What place_splats.comp keeps of a splat's size.
float scale_of(float size) { return KERNEL == LIGHT ? 0.72134752 / (size * size / 25 + 1.0 / 12) : 2 / size; }

// 2 to powers of 0 or less; of those below -100 it is anything.
vec4 exp2_of(vec4 power) {
  vec4 whole = floor(power);
  vec4 rest = power - whole;
  vec4 between = ((rest * 0.0790203 + 0.2241267) * rest + 0.6968386) * rest + 0.9998116;
  return intBitsToFloat(floatBitsToInt(between) + (ivec4(whole) << 23));
}

// How much of a Gaussian lies between its middle and a distance, where 1 is its rim. The polynomial of
// mass_splats_internal.h.
vec4 half_within_gaussian(vec4 scaled) {
  vec4 x = clamp(scaled, -1, 1);
  vec4 s = x * x;
  return x * ((((((0.0665206686 * s - 0.347017288) * s + 0.852566719) * s - 1.35004795) * s + 1.56421399) * s -
               1.38987398) * s + 1.10363781);
}

// The same of the cubic spline kernel, projected on an axis.
vec4 half_within_spline(vec4 scaled) {
  vec4 x = min(abs(scaled), vec4(1));
  vec4 s = x * x;
  vec4 inner = (((4.8 - 3.2 * x) * s - 8.0 / 3) * s + 1.4) * x;
  vec4 rest = 1 - x;
  vec4 outer = 0.5 - (1.6 - 16.0 / 15 * rest) * (rest * rest) * (rest * rest) * rest;
  return sign(scaled) * mix(outer, inner, lessThan(x, vec4(0.5)));
}

vec4 half_within(vec4 scaled) { return KERNEL == SPLINE ? half_within_spline(scaled) : half_within_gaussian(scaled); }

// The weights of four pixels one after the other, of which the first one's middle lies this far from the splat's.
vec4 weights_from(float first, float reach, float scale) {
  if (KERNEL == LIGHT) {
    vec4 away = first + vec4(0, 1, 2, 3);
    return mix(vec4(0), exp2_of(-scale * away * away), lessThanEqual(abs(away), vec4(reach)));
  }
  vec4 at_edges = half_within((first + vec4(-0.5, 0.5, 1.5, 2.5)) * scale);
  float last = half_within(vec4((first + 3.5) * scale)).x;
  return vec4(at_edges.yzw, last) - at_edges;
}
