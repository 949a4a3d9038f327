// The still life's composition: what stands where, in which colours. The seed moves and recolours it.
#include <algorithm>
#include <cassert>
#include <numbers>

#include "wheatstone/synthetic/synthetic_still_internal.h"

namespace wheatstone::still {
namespace {

/// Linear light of an sRGB colour written as 0xRRGGBB.
Vec3 linear(std::uint32_t rgb) {
  const auto channel = [&](int shift) {
    const float v = static_cast<float>((rgb >> shift) & 255) / 255;
    return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
  };
  return {channel(16), channel(8), channel(0)};
}

Pose turned(Vec3 origin, Vec3 up, float turn) {
  Pose pose;
  pose.origin = origin;
  const Vec3 y = normalised(up);
  const Vec3 aside = std::abs(y.x) < 0.9f ? Vec3{1, 0, 0} : Vec3{0, 0, 1};
  const Vec3 z = normalised(cross(aside, y)), x = cross(y, z);
  pose.axes = {x * std::cos(turn) + z * std::sin(turn), y, z * std::cos(turn) - x * std::sin(turn)};
  return pose;
}

/// Colours that go together, sRGB.
struct Palette {
  std::uint32_t wall, dye, second_dye, vase, bowl, brush, grapes, bloom;
};
constexpr Palette palettes[] = {
    {0x6d938f, 0xa3302a, 0xc08a2e, 0x2c5d86, 0xe0dac6, 0x23477e, 0x3a1a3c, 0x77638c},  // dusty teal, cobalt
    {0xc39a5e, 0x24507f, 0x9b3324, 0x2f6f73, 0xe2d8c4, 0x1f5a62, 0x8d9a3c, 0xc9cc8a},  // ochre, petrol
    {0x93a07c, 0x8a2f3c, 0x35603c, 0xa04a26, 0xdcd3bc, 0x7a3020, 0x4a1526, 0x8a5a78},  // sage, terracotta
    {0x7f92b0, 0xb5502a, 0x2c4a78, 0x5f7a4c, 0x2f5d7c, 0xd8d0b8, 0x3a1a3c, 0x77638c},  // grey blue, celadon
    {0xb98d7c, 0x2f5a68, 0xb98a2c, 0x3a5f86, 0xe4dccb, 0x93402c, 0x8d9a3c, 0xc9cc8a},  // rose, blue
};

/// Draws numbers from the seed and puts things on the table.
class Composer {
 public:
  explicit Composer(std::uint64_t seed)
      : seed_(static_cast<std::uint32_t>(seed * 0x9E3779B97F4A7C15ull >> 32) ^ static_cast<std::uint32_t>(seed)),
        palette_(palettes[(seed + std::size(palettes) - 1) % std::size(palettes)]) {}

  void add_room();
  void add_bowl(Vec3 foot);
  void add_vase(Vec3 foot);
  void add_bottle(Vec3 foot);
  void add_cup(Vec3 foot);
  void add_fruit_about();
  void add_beams();
  void add_crowd();
  void add_grapes(Vec3 stalk, float direction);
  Scene take() {
    assert(scene_.casters.size() <= most_casters);
    scene_.reach = reach_of(scene_.casters);
    return std::move(scene_);
  }
  float vary(float amount) { return amount * (2 * uniform() - 1); }

 private:
  float uniform() { return unit_of(lattice_hash(++drawn_, 17, 4, seed_)); }
  std::uint32_t next_seed() { return lattice_hash(++drawn_, 29, 8, seed_) >> 4; }
  Vec3 pick(std::initializer_list<std::uint32_t> colours) {
    return linear(colours.begin()[static_cast<std::size_t>(uniform() * 0.999f * static_cast<float>(colours.size()))]);
  }
  int new_group() { return ++groups_; }
  void add(Pose pose, std::variant<Ellipsoid, Lathe, Panel> shape, Surface surface, int group);
  void add_caster(Pose pose, Vec3 radii, int group, float opacity = 1);
  void add_stalk(Vec3 from, Vec3 to, float radius, const Surface& surface, int group);
  void add_ball(Vec3 centre, Vec3 radii, Vec3 up, const Surface& surface);
  void add_apple(Vec3 foot, float size, Vec3 up);
  void add_pear(Vec3 foot, float size, Vec3 up, float turn);
  void add_orange(Vec3 centre, float radius);
  void add_lemon(Vec3 centre, float size, float turn);
  void add_blossom(Vec3 centre, Vec3 facing, float radius, Vec3 tip, Vec3 heart);
  void add_leaf(Vec3 from, Vec3 along, float size);

  Scene scene_;
  std::uint32_t seed_;
  Palette palette_;
  std::uint32_t drawn_ = 0;
  int groups_ = 0;
};

void Composer::add(Pose pose, std::variant<Ellipsoid, Lathe, Panel> shape, Surface surface, int group) {
  Object object{pose, std::move(shape), surface, {}, 0};
  set_bounds(object);
  scene_.objects.push_back(std::move(object));
  scene_.groups.push_back(group);
}

void Composer::add_caster(Pose pose, Vec3 radii, int group, float opacity) {
  scene_.casters.push_back({pose, radii, std::cbrt(radii.x * radii.y * radii.z), group, opacity});
}

void Composer::add_stalk(Vec3 from, Vec3 to, float radius, const Surface& surface, int group) {
  const float size = length(to - from);
  add(turned(from, to - from, 0),
      make_lathe({{radius * 1.15f, 0}, {radius, size * 0.5f}, {radius * 0.85f, size}, {0.f, size + radius}}, 1),
      surface, group);
}

void Composer::add_room() {
  const Vec3 wall = linear(palette_.wall);
  Pose back;
  back.origin = {0, 0.7f, wall_z};
  back.axes = {Vec3{1, 0, 0}, Vec3{0, 0, -1}, Vec3{0, 1, 0}};
  add(back, Panel{6, 4}, {Material::plaster, wall * 1.35f, wall * 0.70f, next_seed()}, new_group());
  Pose top;
  top.origin = {0, 0, 0.95f};
  add(top, Panel{3.5f, 0.93f}, {Material::table, linear(palette_.dye), linear(palette_.second_dye), next_seed()},
      new_group());
}

void Composer::add_ball(Vec3 centre, Vec3 radii, Vec3 up, const Surface& surface) {
  const int group = new_group();
  const Pose pose = turned(centre, up, 6.28f * uniform());
  add(pose, Ellipsoid{radii}, surface, group);
  add_caster(pose, radii, group);
}

void Composer::add_orange(Vec3 centre, float radius) {
  const Vec3 up = normalised({vary(0.8f), 1, -0.3f + vary(0.6f)});
  add_ball(centre, {radius, radius * 0.95f, radius}, up,
           {Material::orange, linear(0xf08a12), linear(0xe2600a), next_seed()});
  add_ball(centre + up * (radius * 0.945f), {0.0042f, 0.0016f, 0.0042f}, up,
           {Material::stem, linear(0x5a5a20), linear(0x3a3a18), next_seed()});
}

void Composer::add_lemon(Vec3 centre, float size, float turn) {
  const Vec3 along{std::cos(turn), 0.10f, std::sin(turn)};
  const int group = new_group();
  const Pose pose = turned(centre, along, uniform() * 6);
  const Lathe shape = make_lathe({{0.f, -1.38f * size},
                                  {0.16f * size, -1.34f * size},
                                  {0.30f * size, -1.22f * size},
                                  {0.72f * size, -0.80f * size},
                                  {0.98f * size, -0.1f * size},
                                  {0.80f * size, 0.70f * size},
                                  {0.34f * size, 1.18f * size},
                                  {0.15f * size, 1.36f * size},
                                  {0.f, 1.42f * size}},
                                 4);
  add(pose, shape, {Material::lemon, linear(0xf2cb1d), linear(0xe0a80f), next_seed()}, group);
  add_caster(pose, {size, 1.3f * size, size}, group);
}

void Composer::add_apple(Vec3 foot, float size, Vec3 up) {
  const int group = new_group();
  const Pose pose = turned(foot, up, 6.28f * uniform());
  const Lathe shape = make_lathe({{0.f, 0.14f * size},
                                  {0.18f * size, 0.05f * size},
                                  {0.45f * size, 0.02f * size},
                                  {0.80f * size, 0.30f * size},
                                  {1.0f * size, 0.88f * size},
                                  {0.93f * size, 1.36f * size},
                                  {0.62f * size, 1.68f * size},
                                  {0.32f * size, 1.70f * size},
                                  {0.12f * size, 1.56f * size},
                                  {0.f, 1.42f * size}},
                                 4);
  const bool green = uniform() < 0.3f;
  const Vec3 skin = green ? linear(0x8fa52a) : pick({0xb3161a, 0xa81f22, 0xc23a1c});
  add(pose, shape, {Material::apple, skin, green ? linear(0xb9b840) : linear(0xdba43a), next_seed()}, group);
  const Vec3 top = pose.origin + pose.axes[1] * (1.42f * size);
  add_stalk(top, top + pose.axes[1] * (0.5f * size) + Vec3{vary(0.2f) * size, 0, vary(0.2f) * size}, 0.0021f,
            {Material::stem, linear(0x5b3d1e), linear(0x2e1f10), next_seed()}, group);
  add_caster(turned(foot + pose.axes[1] * (0.86f * size), up, 0), {size * 0.98f, size * 0.86f, size * 0.98f}, group);
}

void Composer::add_pear(Vec3 foot, float size, Vec3 up, float turn) {
  const int group = new_group();
  const Pose pose = turned(foot, up, turn);
  const Lathe shape = make_lathe({{0.f, 0.10f * size},
                                  {0.16f * size, 0.04f * size},
                                  {0.42f * size, 0.03f * size},
                                  {0.82f * size, 0.32f * size},
                                  {1.0f * size, 0.86f * size},
                                  {0.86f * size, 1.40f * size},
                                  {0.56f * size, 1.92f * size},
                                  {0.42f * size, 2.36f * size},
                                  {0.28f * size, 2.68f * size},
                                  {0.10f * size, 2.78f * size},
                                  {0.f, 2.74f * size}},
                                 4);
  add(pose, shape, {Material::pear, linear(0xb9ae3a), linear(0xcf7f2e), next_seed()}, group);
  const Vec3 top = pose.origin + pose.axes[1] * (2.72f * size);
  add_stalk(top, top + normalised(pose.axes[1] + Vec3{0.35f, 0, 0.1f}) * (0.62f * size), 0.0026f,
            {Material::stem, linear(0x5b3d1e), linear(0x2e1f10), next_seed()}, group);
  add_caster(turned(foot + pose.axes[1] * (0.88f * size), up, 0), {size * 0.98f, size * 0.88f, size * 0.98f}, group);
  add_caster(turned(foot + pose.axes[1] * (1.75f * size), up, 0), {size * 0.56f, size * 1.0f, size * 0.56f}, group);
}

void Composer::add_bowl(Vec3 foot) {
  const int group = new_group();
  const float r = 0.168f;
  const Lathe shape = make_lathe({{0.058f, 0},
                                  {0.062f, 0.004f},
                                  {0.056f, 0.012f},
                                  {0.090f, 0.024f},
                                  {0.132f, 0.052f},
                                  {0.158f, 0.088f},
                                  {r, 0.103f},
                                  {r - 0.004f, 0.1065f},
                                  {r - 0.010f, 0.103f},
                                  {0.148f, 0.088f},
                                  {0.122f, 0.056f},
                                  {0.080f, 0.034f},
                                  {0.f, 0.027f}},
                                 4);
  Pose pose;
  pose.origin = foot;
  add(pose, shape, {Material::glaze, linear(palette_.bowl), linear(palette_.brush), next_seed() & ~1u}, group);
  pose.origin = foot + Vec3{0, 0.075f, 0};
  add_caster(pose, {r * 0.97f, 0.066f, r * 0.97f}, group);
  scene_.mouths.push_back({foot + Vec3{0, 0.104f, 0}, r - 0.004f, 0.08f, group});

  // Five about the rim, two on top.
  const float start = 6.28f * uniform();
  for (int i = 0; i < 5; ++i) {
    const float angle = start + 2 * pi * static_cast<float>(i) / 5 + vary(0.08f), size = 0.043f + vary(0.002f);
    const Vec3 centre = foot + Vec3{0.092f * std::cos(angle), 0.098f, 0.092f * std::sin(angle)};
    const Vec3 up = normalised({std::cos(angle) * 0.5f + vary(0.3f), 1, std::sin(angle) * 0.5f - 0.2f});
    if (i % 2 == 0) {
      add_orange(centre, size);
    } else if (i == 1) {
      add_apple(centre - up * (0.86f * size), size, up);
    } else {
      add_lemon(centre + Vec3{0, 0.004f, 0}, 0.033f, angle + 1.57f);
    }
  }
  add_orange(foot + Vec3{vary(0.01f), 0.097f, vary(0.01f)}, 0.043f);
  const float lean = vary(0.5f);
  add_apple(foot + Vec3{-0.032f, 0.128f, -0.022f}, 0.044f, normalised({-0.28f + lean * 0.2f, 1, -0.3f}));
  add_orange(foot + Vec3{0.045f, 0.160f, 0.008f}, 0.042f);
}

void Composer::add_blossom(Vec3 centre, Vec3 facing, float radius, Vec3 tip, Vec3 heart) {
  const int group = new_group();
  const Pose pose = turned(centre, facing, 6.28f * uniform());
  const Surface petal{Material::petal, tip, heart, next_seed()};
  for (int ring = 0; ring < 2; ++ring) {
    const int count = ring == 0 ? 11 : 8;
    const float reach = radius * (ring == 0 ? 0.60f : 0.40f), lift = ring == 0 ? 0.30f : 0.75f;
    for (int i = 0; i < count; ++i) {
      const float angle =
          2 * pi * (static_cast<float>(i) + 0.5f * static_cast<float>(ring) + vary(0.12f)) / static_cast<float>(count);
      const Vec3 outward = pose.axes[0] * std::cos(angle) + pose.axes[2] * std::sin(angle);
      const Vec3 lengthwise = normalised(outward + pose.axes[1] * (lift + vary(0.12f)));
      Pose at;
      const Vec3 across = normalised(cross(pose.axes[1], outward));
      at.axes = {across, cross(lengthwise, across), lengthwise};
      at.origin = centre + lengthwise * reach;
      add(at, Ellipsoid{{radius * 0.21f, radius * 0.035f, radius * 0.44f}}, petal, group);
    }
  }
  const Pose middle = turned(centre + pose.axes[1] * (radius * 0.20f), facing, 0);
  add(middle, Ellipsoid{{radius * 0.27f, radius * 0.17f, radius * 0.27f}},
      {Material::blossom_heart, linear(0xd9a21b), linear(0x7a4a10), next_seed()}, group);
  add_caster(turned(centre + pose.axes[1] * (radius * 0.12f), facing, 0),
             {radius * 0.86f, radius * 0.28f, radius * 0.86f}, group, 0.85f);
}

void Composer::add_leaf(Vec3 from, Vec3 along, float size) {
  const Vec3 x = normalised(along);
  const Vec3 z = normalised(cross(x, {vary(0.5f), 1, vary(0.5f) - 0.4f}));
  Pose pose;
  pose.axes = {x, cross(z, x), z};
  pose.origin = from + x * size;
  const int group = new_group();
  add(pose, Ellipsoid{{size, size * 0.06f, size * 0.40f}},
      {Material::leaf, linear(0x3f6a2c), linear(0x7d9a45), next_seed()}, group);
  add_caster(pose, {size, size * 0.12f, size * 0.40f}, group, 0.8f);
}

void Composer::add_vase(Vec3 foot) {
  const int group = new_group();
  const Lathe shape = make_lathe({{0.046f, 0},
                                  {0.052f, 0.006f},
                                  {0.064f, 0.030f},
                                  {0.089f, 0.085f},
                                  {0.091f, 0.125f},
                                  {0.070f, 0.168f},
                                  {0.044f, 0.196f},
                                  {0.040f, 0.214f},
                                  {0.050f, 0.232f},
                                  {0.0525f, 0.2355f},
                                  {0.049f, 0.236f},
                                  {0.040f, 0.226f},
                                  {0.032f, 0.200f}},
                                 4);
  Pose pose;
  pose.origin = foot;
  add(pose, shape, {Material::glaze, linear(palette_.vase), linear(0xdccfa8), next_seed() | 1u}, group);
  pose.origin = foot + Vec3{0, 0.102f, 0};
  add_caster(pose, {0.090f, 0.100f, 0.090f}, group);
  pose.origin = foot + Vec3{0, 0.205f, 0};
  add_caster(pose, {0.046f, 0.05f, 0.046f}, group);

  // Blossoms on a dome over the mouth, the largest in front.
  const Vec3 mouth = foot + Vec3{0, 0.225f, 0};
  const Surface green{Material::stem, linear(0x55742f), linear(0x3a5522), next_seed()};
  struct Place {
    float x, y, z, radius;
  };
  constexpr Place places[] = {
      {-0.120f, 0.085f, -0.02f, 0.052f}, {-0.030f, 0.135f, -0.05f, 0.056f}, {0.078f, 0.105f, -0.04f, 0.050f},
      {-0.075f, 0.175f, 0.05f, 0.046f},  {0.020f, 0.195f, 0.04f, 0.048f},   {0.130f, 0.165f, 0.03f, 0.042f},
      {-0.010f, 0.060f, -0.09f, 0.050f}, {0.135f, 0.050f, 0.00f, 0.040f},   {-0.175f, 0.150f, 0.03f, 0.040f}};
  for (const Place& place : places) {
    const Vec3 centre = mouth + Vec3{place.x + vary(0.012f), place.y + vary(0.012f), place.z + vary(0.015f)};
    const Vec3 facing = normalised({place.x * 4 - 0.15f + vary(0.2f), place.y * 2.2f, -0.62f + vary(0.15f)});
    const Vec3 tip = pick({0xf0e4d2, 0xf1b9a0, 0xe58a5a, 0xf3d9a6, 0xd8566a});
    add_blossom(centre, facing, place.radius, tip, mix(tip, linear(0xc8541e), 0.55f));
    add_stalk(mouth + Vec3{place.x * 0.12f, -0.03f, place.z * 0.12f}, centre - facing * 0.006f, 0.0028f, green, group);
  }
  // Leaves to the sides and behind, where none comes through a blossom.
  for (int i = 0; i < 13; ++i) {
    const float angle = 6.28f * (static_cast<float>(i) + uniform()) / 13, rise = 0.10f + 0.40f * uniform();
    const Vec3 along = normalised({std::cos(angle), rise, 0.6f * std::abs(std::sin(angle)) - 0.1f});
    add_leaf(mouth + along * (0.03f + 0.03f * uniform()) + Vec3{0, 0.01f, 0}, along, 0.036f + 0.016f * uniform());
  }
}

void Composer::add_bottle(Vec3 foot) {
  const int group = new_group();
  const Lathe shape = make_lathe({{0.030f, 0},
                                  {0.043f, 0.003f},
                                  {0.0465f, 0.012f},
                                  {0.047f, 0.07f},
                                  {0.047f, 0.14f},
                                  {0.0465f, 0.198f},
                                  {0.040f, 0.228f},
                                  {0.022f, 0.262f},
                                  {0.0165f, 0.29f},
                                  {0.0155f, 0.335f},
                                  {0.0155f, 0.350f},
                                  {0.0190f, 0.352f},
                                  {0.0190f, 0.365f},
                                  {0.0150f, 0.367f},
                                  {0.f, 0.366f}},
                                 4);
  const Pose pose = turned(foot, {0, 1, 0}, vary(0.35f));
  const bool brown = uniform() < 0.4f;
  add(pose, shape,
      {Material::glass, brown ? linear(0x6a3b14) : linear(0x2f4a22), brown ? linear(0x1c0f08) : linear(0x0d150c),
       next_seed()},
      group);
  for (const float y : {0.05f, 0.10f, 0.15f, 0.19f})
    add_caster(turned(foot + Vec3{0, y, 0}, {0, 1, 0}, 0), {0.046f, 0.062f, 0.046f}, group, 0.9f);
  add_caster(turned(foot + Vec3{0, 0.29f, 0}, {0, 1, 0}, 0), {0.018f, 0.085f, 0.018f}, group, 0.9f);
}

void Composer::add_cup(Vec3 foot) {
  const int group = new_group();
  const Lathe shape = make_lathe({{0.026f, 0},
                                  {0.033f, 0.004f},
                                  {0.040f, 0.024f},
                                  {0.041f, 0.048f},
                                  {0.0435f, 0.072f},
                                  {0.0450f, 0.078f},
                                  {0.0435f, 0.0795f},
                                  {0.0405f, 0.074f},
                                  {0.038f, 0.050f},
                                  {0.036f, 0.02f},
                                  {0.f, 0.012f}},
                                 4);
  Pose pose;
  pose.origin = foot;
  add(pose, shape, {Material::copper, linear(0xc8713c), linear(0x6b3d22), next_seed()}, group);
  pose.origin = foot + Vec3{0, 0.038f, 0};
  add_caster(pose, {0.043f, 0.043f, 0.043f}, group);
  scene_.mouths.push_back({foot + Vec3{0, 0.078f, 0}, 0.0425f, 0.066f, group});
}

void Composer::add_grapes(Vec3 stalk, float direction) {
  const Vec3 dark = linear(palette_.grapes), dust = linear(palette_.bloom);
  const float c = std::cos(direction), s = std::sin(direction);
  // Rows across the bunch: on the cloth, then on top of one another.
  struct Row {
    float along, up;
    int count;
  };
  constexpr Row rows[] = {{0.00f, 0.0135f, 2},  {0.024f, 0.0135f, 4}, {0.048f, 0.0135f, 5}, {0.072f, 0.0135f, 4},
                          {0.096f, 0.0135f, 3}, {0.118f, 0.0135f, 1}, {0.014f, 0.034f, 3},  {0.038f, 0.035f, 4},
                          {0.062f, 0.035f, 3},  {0.086f, 0.033f, 2},  {0.030f, 0.053f, 2},  {0.054f, 0.053f, 2}};
  for (const Row& row : rows) {
    for (int i = 0; i < row.count; ++i) {
      const float across = 0.0245f * (static_cast<float>(i) - 0.5f * static_cast<float>(row.count - 1)) + vary(0.003f);
      const float along = row.along + vary(0.004f), size = 0.0132f + vary(0.0011f);
      const Vec3 centre = stalk + Vec3{along * c - across * s, row.up + vary(0.002f), along * s + across * c};
      add_ball(centre, {size, size * 1.12f, size}, {vary(1), vary(1), 1}, {Material::grape, dark, dust, next_seed()});
    }
  }
  const Surface wood{Material::stem, linear(0x7a5c2e), linear(0x4a3618), next_seed()};
  const int group = new_group();
  const Vec3 start = stalk + Vec3{0.02f * c, 0.060f, 0.02f * s}, bend = stalk + Vec3{-0.035f * c, 0.045f, -0.035f * s};
  add_stalk(start, bend, 0.0028f, wood, group);
  add_stalk(bend, bend + Vec3{-0.004f, 0.010f, 0.026f}, 0.0026f, wood, group);
  add_leaf(bend, {-0.8f * c + 0.4f * s, 0.12f, -0.8f * s - 0.5f * c}, 0.034f);
}

void Composer::add_fruit_about() {
  add_pear({-0.305f + vary(0.02f), 0, 1.19f + vary(0.02f)}, 0.046f, normalised({0.10f, 1, 0.05f}), 0.6f);
  add_pear({-0.235f + vary(0.015f), 0.043f, 1.085f + vary(0.02f)}, 0.043f,
           normalised({0.93f, 0.10f, -0.35f + vary(0.2f)}), 2.0f);
  add_apple({-0.385f + vary(0.015f), 0, 1.33f + vary(0.02f)}, 0.045f, {vary(0.2f), 1, -0.15f});
  add_lemon({-0.035f + vary(0.015f), 0.033f, 0.99f + vary(0.015f)}, 0.032f, 0.5f + vary(0.5f));
  add_apple({0.060f + vary(0.012f), 0, 1.045f + vary(0.01f)}, 0.040f, {0.15f + vary(0.15f), 1, -0.25f});
}

/// Bars a few millimetres thick that stand and lean between the camera and the wall.
void Composer::add_beams() {
  constexpr int beams = 44;
  constexpr float half_width = 1.9f, half_length = 0.45f;
  for (int i = 0; i < beams; ++i) {
    const float place = (static_cast<float>(i) + uniform()) / beams;
    const Vec3 centre{half_width * (2 * place - 1), 0.33f, 0.95f + 1.15f * uniform()};
    const float radius = 0.004f + 0.004f * uniform();
    const Vec3 colour = pick({0x1c1a18, 0xe8e2d2, 0xa3302a, 0x2c5d86, 0x24221f, 0xe0b040});
    add(turned(centre, {vary(0.5f), 1, vary(0.05f)}, 0), Ellipsoid{{radius, half_length, radius}},
        {Material::stem, colour, colour * 0.7f, next_seed()}, new_group());
  }
}

/// Little figures on the table, each in a lane of its own.
void Composer::add_crowd() {
  constexpr int figures = 70, stride = 27;  // so that neighbouring lanes are far apart in colour and way
  for (int i = 0; i < figures; ++i) {
    const float lane = 0.86f + 0.94f * static_cast<float>(i * stride % figures) / figures;
    const float size = 0.8f + 0.5f * uniform();
    const int group = new_group();
    const Vec3 coat = pick({0xa3302a, 0x2c5d86, 0xe8e2d2, 0x35603c, 0x1c1a18, 0xe0b040, 0x8a5a78});
    add(turned({0, 0.034f * size, lane}, {0, 1, 0}, 0), Ellipsoid{Vec3{0.014f, 0.034f, 0.012f} * size},
        {Material::stem, coat, coat * 0.7f, next_seed()}, group);
    add(turned({0, 0.074f * size, lane}, {0, 1, 0}, 0), Ellipsoid{Vec3{0.010f, 0.012f, 0.010f} * size},
        {Material::stem, linear(0xc89878), linear(0x8a6048), next_seed()}, group);
  }
}

}  // namespace

Scene compose_beams(std::uint64_t seed) {
  Composer composer(seed);
  composer.add_room();
  composer.add_beams();
  return composer.take();
}

Scene compose_crowd(std::uint64_t seed) {
  Composer composer(seed);
  composer.add_room();
  composer.add_crowd();
  return composer.take();
}

Scene compose_still(std::uint64_t seed) {
  Composer composer(seed);
  composer.add_room();
  composer.add_bowl({0.155f + composer.vary(0.02f), 0, 1.30f + composer.vary(0.02f)});
  composer.add_vase({-0.185f + composer.vary(0.02f), 0, 1.50f + composer.vary(0.03f)});
  composer.add_bottle({0.325f + composer.vary(0.025f), 0, 1.60f + composer.vary(0.03f)});
  composer.add_cup({0.355f + composer.vary(0.01f), 0, 1.27f + composer.vary(0.02f)});
  composer.add_fruit_about();
  composer.add_grapes({0.165f + composer.vary(0.01f), 0, 0.985f}, 0.25f + composer.vary(0.15f));
  return composer.take();
}

}  // namespace wheatstone::still
