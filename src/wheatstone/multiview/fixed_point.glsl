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
