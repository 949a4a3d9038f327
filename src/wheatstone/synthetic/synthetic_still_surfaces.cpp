// What the still life's things are made of: procedural textures with variation at several scales. Detail finer than a
// pixel is faded out, so that pictures of any size are free of moiré.
#include <algorithm>
#include <array>
#include <numbers>

#include "wheatstone/synthetic/synthetic_still_internal.h"

namespace wheatstone::still {
namespace {

/// How much of a detail of that many waves a metre a picture can show, 1 to 0.
float shown(float frequency, float footprint) { return clamp01(1.7f - 2.6f * frequency * footprint); }

/// Sum of at most four octaves from `frequency` waves a metre, each half as strong as the one before.
Noise octaves(Vec3 p, float frequency, int count, float footprint, std::uint32_t seed) {
  constexpr int at_once = 4;
  FourFloats frequencies{};
  std::array<float, at_once> shares;
  int octaves_shown = 0;
  float strength = 0.5f;
  for (int i = 0; i < std::min(count, at_once); ++i) {
    const float share = strength * shown(frequency, footprint);
    if (share <= 0) break;
    frequencies[octaves_shown] = frequency;
    shares[octaves_shown++] = share;
    strength *= 0.5f;
    frequency *= 2.03f;
  }
  Noise sum;
  if (octaves_shown == 0) return sum;
  const FourWords seeds = FourWords{0, 101, 202, 303} + seed;
  const FourNoises all = four_noises_at({p.x * frequencies, p.y * frequencies, p.z * frequencies}, seeds);
  for (int i = 0; i < octaves_shown; ++i) {
    sum.value += shares[i] * all.value[i];
    sum.slope += shares[i] * frequencies[i] * Vec3{all.slope.x[i], all.slope.y[i], all.slope.z[i]};
  }
  return sum;
}

/// Tilts a normal against the slope of a height, in metres a metre.
Vec3 embossed(Vec3 normal, Vec3 slope) { return normalised(normal - (slope - normal * dot(slope, normal))); }

/// A smooth-edged stripe: 1 where |v| < half_width.
float stripe(float v, float half_width, float soft) {
  return 1 - smooth_step(half_width - soft, half_width + soft, std::abs(v));
}

float distance_to_whole(float v) { return v - std::round(v); }

Finish plaster(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise clouds = octaves(p, 1.6f, 4, footprint, s.seed);
  const Noise trowel = octaves({p.x, p.y, p.z * 2.6f}, 9, 4, footprint, s.seed + 7);
  const Noise grain = octaves(p, 120, 3, footprint, s.seed + 13);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, clamp01(0.45f + 0.85f * clouds.value + 0.35f * trowel.value));
  finish.colour = finish.colour * (1 + 0.26f * trowel.value + 0.22f * grain.value);
  finish.normal = embossed(n, 0.0032f * trowel.slope + 0.0006f * grain.slope);
  return finish;
}

/// Planks along x. Panels lie in y = 0 of their frame.
Finish wood(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  constexpr float plank_width = 0.19f;
  const float place = p.z / plank_width + 0.37f;
  const auto plank = static_cast<std::uint32_t>(static_cast<int>(std::floor(place)) + 64);
  const float random = unit_of(lattice_hash(plank, 3, 5, s.seed));
  const Vec3 q{p.x + 7 * random, random * 3, p.z};

  const Noise sway = octaves({q.x * 0.8f, q.y, q.z * 2}, 2.2f, 2, footprint, s.seed + plank);
  const float ring_frequency = 46;
  const float rings = std::sin(2 * pi * (ring_frequency * q.z + 2.6f * sway.value)) * shown(ring_frequency, footprint);
  const Noise fibres = octaves({q.x * 0.05f, q.y, q.z}, 170, 3, footprint, s.seed + 19);
  const Noise stains = octaves({q.x * 0.5f, q.y, q.z}, 6, 4, footprint, s.seed + 23);
  const float joint = stripe(distance_to_whole(place - 0.5f) * plank_width, 0.0011f, 0.0008f + footprint);

  Finish finish;
  const float tone =
      clamp01(0.42f + 0.16f * rings + 0.45f * fibres.value + 0.55f * stains.value + 0.35f * (random - 0.5f));
  finish.colour = mix(s.second_colour, s.colour, tone) * (1 - 0.75f * joint);
  finish.normal = embossed(n, 0.0009f * fibres.slope + Vec3{0, 0, 0.01f * rings});
  finish.gloss = 0.16f + 0.08f * fibres.value;
  finish.sharpness = 18;
  return finish;
}

/// Where the cloth lies on the table: its own coordinates along and across, in metres.
struct ClothPlace {
  float along, across;
};
ClothPlace cloth_place(Vec3 p, float turn) {
  const float x = p.x - 0.03f, z = p.z - 0.10f;
  return {x * std::cos(turn) + z * std::sin(turn), z * std::cos(turn) - x * std::sin(turn)};
}

/// Linen with coloured stripes along its edges, woven, with a few creases.
Finish linen(const Surface& s, Vec3 p, Vec3 n, const ClothPlace& at, float footprint) {
  constexpr float half_width = 0.225f, threads = 420;
  const Noise creases = octaves({at.along * 0.7f, 0, at.across}, 5.5f, 3, footprint, s.seed + 31);
  const Noise slub = octaves({at.along * 0.25f, 3, at.across}, 150, 2, footprint, s.seed + 37);
  const Noise blotch = octaves({at.along, 9, at.across}, 30, 3, footprint, s.seed + 41);
  const float weave =
      std::sin(2 * pi * threads * at.along) * std::sin(2 * pi * threads * at.across) * shown(threads, footprint);

  const float edge = half_width - std::abs(at.across), soft = 0.0007f + 0.6f * footprint;
  const Vec3 ground{0.72f, 0.64f, 0.50f};
  Vec3 colour = ground * (1 + 0.16f * slub.value + 0.10f * weave + 0.12f * blotch.value);
  float dyed = std::max(
      {stripe(edge - 0.035f, 0.014f, soft), stripe(edge - 0.062f, 0.0035f, soft), stripe(edge - 0.012f, 0.003f, soft)});
  float second = std::max(stripe(edge - 0.088f, 0.008f, soft), stripe(edge - 0.107f, 0.002f, soft));
  // Cross stripes near the ends.
  const float end = 0.52f - std::abs(at.along);
  dyed = std::max({dyed, stripe(end - 0.04f, 0.014f, soft), stripe(end - 0.085f, 0.0035f, soft)});
  second = std::max(second, stripe(end - 0.066f, 0.006f, soft));
  colour = mix(colour, s.colour * (0.9f + 0.35f * slub.value + 0.25f * weave + 0.4f * blotch.value), 0.92f * dyed);
  colour =
      mix(colour, s.second_colour * (0.9f + 0.35f * slub.value + 0.25f * weave + 0.4f * blotch.value), 0.9f * second);

  Finish finish;
  finish.colour = colour;
  const float turned_x = creases.slope.x, turned_z = creases.slope.z;
  // Pressed folds, as cloth has that lay in a drawer.
  const auto fold = [](float v) { return v / 0.010f * std::exp(-v * v / (0.010f * 0.010f)); };
  const float fold_along = 0.30f * (fold(at.along) + fold(at.along - 0.27f) + fold(at.along + 0.27f)),
              fold_across = 0.30f * fold(at.across);
  finish.normal =
      embossed(n, Vec3{0.040f * turned_x + fold_along, 0, 0.040f * turned_z + fold_across} + 0.0011f * slub.slope);
  (void)p;
  return finish;
}

Finish table(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const float turn = 0.24f + 0.12f * (unit_of(lattice_hash(1, 2, 3, s.seed)) - 0.5f);
  const ClothPlace at = cloth_place(p, turn);
  // A hem that is not quite straight, and the dark line of its shadow on the wood.
  const float wave = 0.002f * noise_at({at.along * 14, 0, 0}, s.seed + 3).value;
  const float inside = std::min(0.225f + wave - std::abs(at.across), 0.52f - std::abs(at.along));
  Finish finish;
  Surface boards = s;
  boards.colour = {0.50f, 0.245f, 0.095f};
  boards.second_colour = {0.115f, 0.047f, 0.020f};
  if (inside < 0.02f) finish = wood(boards, p, n, footprint);
  finish.colour = finish.colour * mix(0.45f, 1.f, smooth_step(0, 0.012f, -inside));
  if (inside < -footprint) return finish;
  const Finish cloth = linen(s, p, n, at, footprint);
  const float share = smooth_step(-0.5f * footprint - 1e-5f, 0.5f * footprint + 1e-5f, inside);
  finish.colour = mix(finish.colour, cloth.colour, share);
  finish.normal = share > 0.5f ? cloth.normal : finish.normal;
  finish.gloss *= 1 - share;
  return finish;
}

/// Glazed earthenware with a brushed band; the foot is left bare.
Finish glaze(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const float angle = std::atan2(p.z, p.x);
  const Noise pool = octaves(p, 13, 4, footprint, s.seed);
  const Noise speckle = octaves(p, 210, 2, footprint, s.seed + 5);
  const Noise brush = octaves({angle * 0.5f, p.y * 22, 0}, 5, 3, footprint * 8, s.seed + 11);
  Vec3 colour = s.colour * (1 + 0.42f * pool.value);
  colour = mix(colour, s.second_colour, 0.55f * smooth_step(0.16f, 0.34f, speckle.value + 0.25f * pool.value));

  // Leaves painted round the body, two rings above and below them. p.y counts from the foot.
  const float band = s.seed % 2 == 0 ? 0.062f : 0.105f;
  const float turns = angle / (2 * pi) * 14, leaf = distance_to_whole(turns);
  const float height = (p.y - band) / 0.019f;
  const float slant = std::abs(leaf - 0.16f * height) - 0.30f * std::max(0.f, 1 - height * height);
  const float painted = std::abs(height) < 1 ? 1 - smooth_step(-0.05f, 0.05f, slant) : 0.f;
  const float rings = std::max(stripe(p.y - band - 0.027f, 0.0022f, 0.0006f + footprint),
                               stripe(p.y - band + 0.027f, 0.0022f, 0.0006f + footprint));
  colour =
      mix(colour, s.second_colour * (1 + 0.5f * brush.value), std::max(painted, rings) * (0.78f + 0.3f * brush.value));

  Finish finish;
  finish.colour = colour;
  finish.normal = embossed(n, 0.0016f * pool.slope + 0.00012f * speckle.slope);
  finish.gloss = 0.75f;
  finish.sharpness = 120;
  return finish;
}

/// Dark bottle glass with a paper label that faces the window.
Finish glass(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise depth = octaves({p.x, p.y * 0.35f, p.z}, 30, 3, footprint, s.seed);
  Finish finish;
  const float facing = std::abs(n.z);
  finish.colour = mix(s.second_colour, s.colour, clamp01(0.30f + 0.5f * facing + 0.55f * depth.value));
  finish.normal = embossed(n, 0.0012f * depth.slope);
  finish.gloss = 0.9f;
  finish.sharpness = 160;
  const float angle = std::atan2(-p.x, -p.z) - 0.15f, high = p.y - 0.125f;
  const float in_label = std::min(0.95f - std::abs(angle), (0.052f - std::abs(high)) / 0.045f);
  if (in_label < 0) return finish;

  const Noise paper = octaves({angle * 0.04f, p.y, 0}, 90, 3, footprint, s.seed + 9);
  finish.colour = Vec3{0.66f, 0.56f, 0.38f} * (1 + 0.3f * paper.value);
  const float soft = 0.0005f + 0.6f * footprint;
  const float frame =
      stripe(std::min((0.95f - std::abs(angle)) * 0.045f, 0.052f - std::abs(high)) - 0.006f, 0.001f, soft);
  const float words = stripe(high - 0.012f, 0.009f, soft) *
                      smooth_step(-0.05f, 0.15f, std::sin(angle * 17) + 0.4f * std::sin(angle * 41)) *
                      (std::abs(angle) < 0.72f ? 1.f : 0.f);
  const float lines = (stripe(high + 0.013f, 0.002f, soft) + stripe(high + 0.023f, 0.002f, soft)) *
                      (std::abs(angle) < 0.55f ? 1.f : 0.f);
  finish.colour = mix(finish.colour, {0.22f, 0.045f, 0.03f}, 0.85f * std::min(1.f, frame + words + lines));
  finish.normal = n;
  finish.gloss = 0.08f;
  finish.sharpness = 12;
  return finish;
}

/// Orange and lemon: pores, unevenly ripe; green about the stem.
Finish citrus(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise ripe = octaves(p, 16, 4, footprint, s.seed);
  const Noise pores = octaves(p, 210, 2, footprint, s.seed + 3);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, clamp01(0.30f + 1.0f * ripe.value));
  finish.colour = finish.colour * (1 + 0.42f * pores.value);
  const float at_stem = smooth_step(0.90f, 0.995f, n.y);
  finish.colour = mix(finish.colour, {0.20f, 0.22f, 0.03f}, 0.6f * at_stem);
  finish.normal = embossed(n, 0.0012f * pores.slope);
  finish.gloss = 0.34f;
  finish.sharpness = 26;
  return finish;
}

/// Streaks from the stem down, lighter dots, the shaded side less ripe.
Finish apple(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const float angle = std::atan2(p.z, p.x), radius = std::max(std::hypot(p.x, p.z), 0.004f);
  const Noise side = octaves(p, 11, 3, footprint, s.seed);
  const Vec3 round{std::cos(angle) * 2.2f, p.y * 9, std::sin(angle) * 2.2f};
  const Noise streaks = octaves(round, 3.4f, 4, footprint * 2.2f / radius, s.seed + 5);
  const Noise dots = octaves(p, 170, 1, footprint, s.seed + 9);
  Finish finish;
  const float red = smooth_step(-0.36f, 0.34f, 0.6f * side.value + 0.9f * streaks.value + 0.16f);
  finish.colour = mix(s.second_colour, s.colour, red);
  finish.colour = finish.colour * (1 + 0.30f * streaks.value);
  finish.colour = mix(finish.colour, {0.75f, 0.55f, 0.25f}, 0.55f * smooth_step(0.28f, 0.42f, dots.value));
  const float hollow = 1 - smooth_step(0.006f, 0.020f, radius);
  finish.colour = mix(finish.colour, {0.16f, 0.11f, 0.03f}, 0.7f * hollow);
  finish.normal = embossed(n, 0.0006f * side.slope);
  finish.gloss = 0.55f;
  finish.sharpness = 55;
  return finish;
}

Finish pear(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise blush = octaves(p, 9, 3, footprint, s.seed);
  const Noise speckles = octaves(p, 230, 2, footprint, s.seed + 3);
  const Noise russet = octaves({p.x, p.y * 0.6f, p.z}, 40, 4, footprint, s.seed + 7);
  Finish finish;
  const float sunny = smooth_step(-0.2f, 0.9f, -n.x * 0.7f - n.z * 0.4f + 0.9f * blush.value);
  finish.colour = mix(s.colour, s.second_colour, 0.75f * sunny) * (1 + 0.35f * russet.value);
  const float brown = smooth_step(0.14f, 0.34f, speckles.value) + 0.8f * smooth_step(0.12f, 0.5f, russet.value);
  finish.colour = mix(finish.colour, {0.20f, 0.095f, 0.025f}, 0.62f * clamp01(brown));
  finish.normal = embossed(n, 0.0003f * speckles.slope + 0.0008f * russet.slope);
  finish.gloss = 0.26f;
  finish.sharpness = 24;
  return finish;
}

Finish grape(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise bloom = octaves(p, 70, 4, footprint, s.seed);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, clamp01(0.28f + 0.9f * bloom.value));
  finish.normal = n;
  finish.gloss = 0.42f - 0.3f * clamp01(bloom.value * 2);
  finish.sharpness = 60;
  finish.translucence = 0.35f;
  return finish;
}

/// Petals lie along z of their frame, leaves along x; both with veins.
Finish petal(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise veins = octaves({p.x * 3, 0, p.z * 0.5f}, 160, 2, footprint * 2, s.seed);
  const Noise tint = octaves(p, 50, 2, footprint, s.seed + 3);
  Finish finish;
  const float outwards = smooth_step(-0.018f, 0.02f, p.z);
  finish.colour = mix(s.second_colour, s.colour, clamp01(outwards + 0.4f * tint.value)) * (1 + 0.35f * veins.value);
  finish.normal = embossed(n, 0.0009f * veins.slope);
  finish.translucence = 0.45f;
  return finish;
}

Finish leaf(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise tone = octaves(p, 60, 3, footprint, s.seed);
  const float rib = stripe(p.z, 0.0010f, 0.0007f + footprint);
  const float veins = std::sin(2 * pi * (p.x - 0.7f * std::abs(p.z)) * 150) * shown(210, footprint);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, clamp01(0.4f + 0.9f * tone.value + 0.12f * veins));
  finish.colour = mix(finish.colour, s.second_colour * 1.5f, 0.6f * rib);
  finish.normal = embossed(n, {0.10f * veins, 0, p.z > 0 ? 0.22f : -0.22f});
  finish.gloss = 0.2f;
  finish.translucence = 0.35f;
  return finish;
}

Finish rough(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const Noise grain = octaves(p, 140, 3, footprint, s.seed);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, clamp01(0.5f + grain.value));
  finish.normal = embossed(n, 0.0015f * grain.slope);
  return finish;
}

/// Hammered copper, tarnished in places.
Finish copper(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const float angle = std::atan2(p.z, p.x);
  const Vec3 round{std::cos(angle) * 0.045f, p.y, std::sin(angle) * 0.045f};
  const Noise dents = octaves(round, 85, 2, footprint, s.seed);
  const Noise tarnish = octaves(p, 26, 4, footprint, s.seed + 3);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, clamp01(0.35f + 1.1f * tarnish.value));
  finish.normal = embossed(n, 0.0050f * dents.slope);
  finish.gloss = 1.0f;
  finish.sharpness = 34;
  return finish;
}

/// A woven pattern on folds; y of the frame runs up.
Finish velvet(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  const float u = p.x * 9, v = p.y * 6;
  const Noise pile = octaves(p, 130, 3, footprint, s.seed);
  const Noise wear = octaves({p.x, p.y * 0.3f, p.z}, 8, 3, footprint, s.seed + 3);
  const float figure =
      std::cos(2 * pi * u) + std::cos(2 * pi * v) + 0.7f * std::cos(2 * pi * (u + v)) * std::cos(2 * pi * (u - v));
  const float woven = smooth_step(0.35f, 0.55f, figure);
  Finish finish;
  finish.colour = mix(s.colour, s.second_colour, 0.75f * woven) * (1 + 0.4f * pile.value + 0.5f * wear.value);
  finish.normal = embossed(n, 0.001f * pile.slope);
  finish.gloss = 0.05f;
  finish.sharpness = 6;
  return finish;
}

}  // namespace

Finish finish_at(const Surface& s, Vec3 p, Vec3 n, float footprint) {
  switch (s.material) {
    case Material::plaster:
      return plaster(s, p, n, footprint);
    case Material::table:
      return table(s, p, n, footprint);
    case Material::glaze:
      return glaze(s, p, n, footprint);
    case Material::glass:
      return glass(s, p, n, footprint);
    case Material::orange:
    case Material::lemon:
      return citrus(s, p, n, footprint);
    case Material::apple:
      return apple(s, p, n, footprint);
    case Material::pear:
      return pear(s, p, n, footprint);
    case Material::grape:
      return grape(s, p, n, footprint);
    case Material::petal:
      return petal(s, p, n, footprint);
    case Material::leaf:
      return leaf(s, p, n, footprint);
    case Material::copper:
      return copper(s, p, n, footprint);
    case Material::velvet:
      return velvet(s, p, n, footprint);
    case Material::blossom_heart:
    case Material::stem:
      return rough(s, p, n, footprint);
  }
  return {};
}

}  // namespace wheatstone::still
