// Noise that belongs to a stroke, by the seed of its bristles: the twin of class Bristles.

// A hash of a lattice point, 0..1.
float lattice(uint seed, uint which, int point) {
  uint h = uint(point) * 0x9e3779b9u + seed + which * 0x85ebca6bu;
  h = (h ^ h >> 16) * 0x7feb352du;
  h = (h ^ h >> 15) * 0x846ca68bu;
  return float((h ^ h >> 16) >> 8) / 16777216.0;
}

// Smooth noise 0..1 between lattice points a unit apart; `which` tells several apart.
float noise(uint seed, uint which, float place) {
  float cell = floor(place);
  float part = place - cell;
  return mix(lattice(seed, which, int(cell)), lattice(seed, which, int(cell) + 1), part * part * (3 - 2 * part));
}
