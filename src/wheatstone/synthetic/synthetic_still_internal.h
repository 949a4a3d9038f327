#pragma once

// The still life as data: shapes with a pose and a surface, what casts shadows, and the functions that look at them.
// World: metres, x to the right, y up, z away from the camera; the table's top is y = 0.

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <variant>
#include <vector>

namespace wheatstone::still {

inline constexpr float pi = std::numbers::pi_v<float>;

struct Vec3 {
  float x = 0, y = 0, z = 0;
};
inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator*(Vec3 a, Vec3 b) { return {a.x * b.x, a.y * b.y, a.z * b.z}; }
inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
inline Vec3 operator*(float s, Vec3 a) { return a * s; }
inline Vec3& operator+=(Vec3& a, Vec3 b) { return a = a + b; }
inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(Vec3 a, Vec3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float length(Vec3 a) { return std::sqrt(dot(a, a)); }
inline Vec3 normalised(Vec3 a) { return a * (1 / length(a)); }
inline Vec3 mix(Vec3 a, Vec3 b, float share) { return a + (b - a) * share; }
inline float mix(float a, float b, float share) { return a + (b - a) * share; }
inline float clamp01(float v) { return v < 0 ? 0.f : v > 1 ? 1.f : v; }
inline float smooth_step(float from, float to, float v) {
  const float s = clamp01((v - from) / (to - from));
  return s * s * (3 - 2 * s);
}

/// A place and three right-angled unit axes. Shapes stand in their own frame: y along their axis of revolution.
struct Pose {
  Vec3 origin;
  std::array<Vec3, 3> axes{Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}};

  Vec3 direction_in(Vec3 d) const { return {dot(axes[0], d), dot(axes[1], d), dot(axes[2], d)}; }
  Vec3 point_in(Vec3 p) const { return direction_in(p - origin); }
  Vec3 direction_out(Vec3 d) const { return axes[0] * d.x + axes[1] * d.y + axes[2] * d.z; }
};

struct Ellipsoid {
  Vec3 radii;
};

/// A surface of revolution about y: the cones between successive points of a profile. The surface looks outward where
/// the profile goes up and inward where it comes down again.
struct Lathe {
  struct Ring {
    float radius, y;
    float normal_radius, normal_y;  ///< the smooth surface's normal
  };
  std::vector<Ring> rings;
};

/// A rectangle in the plane y = 0.
struct Panel {
  float half_x, half_z;
};

enum class Material : std::uint8_t {
  plaster,
  table,
  glaze,
  glass,
  orange,
  lemon,
  apple,
  pear,
  grape,
  petal,
  blossom_heart,
  leaf,
  stem,
  copper,
  velvet
};

struct Surface {
  Material material{};
  Vec3 colour;         ///< linear
  Vec3 second_colour;  ///< linear
  std::uint32_t seed = 0;
};

struct Object {
  Pose pose;
  std::variant<Ellipsoid, Lathe, Panel> shape;
  Surface surface;
  Vec3 bound_centre;
  float bound_radius = 0;
};

/// An ellipsoid that stands for an object, or a part of it, where soft shadows are worked out.
struct ShadowCaster {
  Pose pose;
  Vec3 radii;
  float mean_radius = 0;
  int group = 0;  ///< objects of the same group cast no shadow on themselves this way
  float opacity = 1;
};

inline constexpr std::size_t most_casters = 256;

/// The mouth of an open vessel: what lies within is shaded by the rim and not by the vessel's casters.
struct Mouth {
  Vec3 centre;
  float radius = 0;
  float depth = 0;
  int group = 0;
};

/// How far the casters reach, field by field, so that most are passed over at a glance.
struct CasterReach {
  std::vector<float> x, y, z;
  std::vector<float> shadow;          ///< radius about the caster's centre, in metres
  std::vector<float> ambient_square;  ///< squared distance to which it takes the room's light
};

struct Scene {
  std::vector<Object> objects;
  std::vector<int> groups;  ///< of each object
  /// Where each object took its light, if that is not where it is: things that move carry it along.
  std::vector<Pose> lit_poses;
  std::vector<ShadowCaster> casters;
  CasterReach reach;
  std::vector<Mouth> mouths;
};

struct Ray {
  Vec3 origin;
  Vec3 direction;
};

/// The nearest point of a ray: `distance` counts lengths of the ray's direction.
struct Hit {
  float distance = 0;
  int object = -1;
  int part = 0;  ///< of a lathe: the cone
};

// Stage and camera, which the composition and the cameras share.
inline constexpr Vec3 cyclopean_eye{0, 0.43f, 0};
inline constexpr float camera_pitch_rad = 0.235f;
inline constexpr float half_height_of_view = 0.256f;  ///< tangent of half the vertical field of view
inline constexpr float wall_z = 2.3f;

Scene compose_still(std::uint64_t seed);
/// The same room with thin bars, or with little figures on the table, in place of the still life; nothing casts
/// shadows.
Scene compose_beams(std::uint64_t seed);
Scene compose_crowd(std::uint64_t seed);
CasterReach reach_of(const std::vector<ShadowCaster>& casters);

/// True where the ray meets the object nearer than `hit`, which then tells where.
bool find_hit(const Object& object, const Ray& ray, Hit& hit);
/// Outward unit normal, in the object's own frame, of one of its points.
Vec3 normal_at(const Object& object, Vec3 point_in_object, int part);
Lathe make_lathe(const std::vector<std::array<float, 2>>& profile, int steps_between);
void set_bounds(Object& object);

/// What a surface is like at a point; `normal` in the object's frame, with relief.
struct Finish {
  Vec3 colour;  ///< linear reflectance
  Vec3 normal;
  float gloss = 0;         ///< strength of the highlight
  float sharpness = 20;    ///< its exponent
  float translucence = 0;  ///< light that comes round the edge, 0..1
};
/// `footprint` is the width of a pixel at the point, in metres: finer detail is left out.
Finish finish_at(const Surface& surface, Vec3 point_in_object, Vec3 normal, float footprint);

/// How much of the window's and of the room's light reaches a point; it varies slowly.
struct Illumination {
  float key = 0;
  float ambient = 0;
};
Illumination illumination_at(const Scene& scene, Vec3 point, Vec3 normal, int group);
/// Linear light, tone-mapped to 0..1, that leaves a point for the cyclopean eye.
Vec3 shade(const Finish& finish, Vec3 point, Vec3 normal, const Illumination& light);

/// Smooth noise in −1..1 and its slope. Wave length about 1.
struct Noise {
  float value = 0;
  Vec3 slope;
};
Noise noise_at(Vec3 p, std::uint32_t seed);

/// The same at four places at once, each with its own seed.
using FourFloats = float __attribute__((vector_size(16)));
using FourWords = std::uint32_t __attribute__((vector_size(16)));
struct FourPlaces {
  FourFloats x, y, z;
};
struct FourNoises {
  FourFloats value;
  FourPlaces slope;
};
FourNoises four_noises_at(const FourPlaces& places, FourWords seed);
std::uint32_t lattice_hash(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t seed);
inline float unit_of(std::uint32_t hashed) { return static_cast<float>(hashed >> 8) * 0x1p-24f; }

}  // namespace wheatstone::still
