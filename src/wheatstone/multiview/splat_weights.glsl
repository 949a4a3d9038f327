// How much of a splat's light a pixel gets, along one axis. The twin of deposit_simd.cpp.

float sharpness_of(float size, bool of_mass) {
  return of_mass ? 5.5 * 0.70710678 / size : 0.72134752 / (size * size / 25 + 1.0 / 12);
}

// How much of a Gaussian lies between its middle and a distance, in √2 deviations; all of a half beyond its rim.
// Abramowitz & Stegun 1964, 7.1.26.
vec4 half_within(vec4 scaled) {
  vec4 x = abs(scaled);
  vec4 t = 1 / (0.3275911 * x + 1);
  vec4 tail = ((((1.061405429 * t - 1.453152027) * t + 1.421413741) * t - 0.284496736) * t + 0.254829592) * t;
  vec4 within = (1 - tail * exp2(x * x * -1.44269504)) * (0.5 / 0.994040);
  return sign(scaled) * min(within, 0.5);
}

// The weights of pixels whose centres are this far from the splat's.
vec4 weights_at(vec4 away, float reach, float sharpness, bool of_mass) {
  vec4 weights = of_mass ? half_within((away + 0.5) * sharpness) - half_within((away - 0.5) * sharpness)
                         : exp2(-sharpness * away * away);
  return mix(vec4(0), weights, lessThanEqual(abs(away), vec4(reach)));
}
