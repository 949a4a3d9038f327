// Where rays meet the still life's shapes.
#include <algorithm>

#include "wheatstone/synthetic/synthetic_still_internal.h"

namespace wheatstone::still {
namespace {

/// Neighbouring cones overlap by this much, in metres, so that no ray slips between them.
constexpr float overlap = 1e-6f;

/// Ray in an object's frame, begun where it comes nearest to the object's bounds: there floats are exact enough.
struct LocalRay {
  Vec3 origin, direction;
  float start = 0;        ///< distance of `origin` along the whole ray
  float half_height = 0;  ///< of the ray's part within the bounds: it stays this near to its origin in y
};

bool find_hit(const Ellipsoid& shape, const LocalRay& ray, Hit& hit) {
  const Vec3 inverse{1 / shape.radii.x, 1 / shape.radii.y, 1 / shape.radii.z};
  const Vec3 o = ray.origin * inverse, d = ray.direction * inverse;
  const float a = dot(d, d), b = dot(o, d), c = dot(o, o) - 1;
  const float discriminant = b * b - a * c;
  if (discriminant <= 0) return false;
  const float distance = ray.start + (-b - std::sqrt(discriminant)) / a;
  if (distance <= 0 || distance >= hit.distance) return false;
  hit.distance = distance;
  return true;
}

/// Both ends of the ray's way through one cone between two rings; the nearer that lies between them.
bool find_cone_hit(const Lathe::Ring& lower, const Lathe::Ring& upper, const LocalRay& ray, Hit& hit) {
  const Vec3 &o = ray.origin, &d = ray.direction;
  const float slope = (upper.radius - lower.radius) / (upper.y - lower.y);
  const float radius = lower.radius + slope * (o.y - lower.y), growth = slope * d.y;
  const float a = d.x * d.x + d.z * d.z - growth * growth;
  const float b = o.x * d.x + o.z * d.z - radius * growth;
  const float c = o.x * o.x + o.z * o.z - radius * radius;
  const float discriminant = b * b - a * c;
  if (discriminant <= 0) return false;
  const float root = std::sqrt(discriminant);
  const float lowest = std::min(lower.y, upper.y) - overlap, highest = std::max(lower.y, upper.y) + overlap;
  bool found = false;
  for (const float sign : {-1.f, 1.f}) {
    const float step = (-b + sign * root) / a;
    const float y = o.y + step * d.y, distance = ray.start + step;
    if (y < lowest || y > highest || distance <= 0 || distance >= hit.distance) continue;
    hit.distance = distance;
    found = true;
  }
  return found;
}

bool find_hit(const Lathe& shape, const LocalRay& ray, Hit& hit) {
  bool found = false;
  const float low = ray.origin.y - ray.half_height, high = ray.origin.y + ray.half_height;
  for (std::size_t i = 0; i + 1 < shape.rings.size(); ++i) {
    const float a = shape.rings[i].y, b = shape.rings[i + 1].y;
    if ((a < low && b < low) || (a > high && b > high)) continue;
    if (!find_cone_hit(shape.rings[i], shape.rings[i + 1], ray, hit)) continue;
    hit.part = static_cast<int>(i);
    found = true;
  }
  return found;
}

bool find_hit(const Panel& shape, const LocalRay& ray, Hit& hit) {
  const float step = -ray.origin.y / ray.direction.y, distance = ray.start + step;
  if (!(distance > 0) || distance >= hit.distance) return false;
  if (std::abs(ray.origin.x + step * ray.direction.x) > shape.half_x) return false;
  if (std::abs(ray.origin.z + step * ray.direction.z) > shape.half_z) return false;
  hit.distance = distance;
  return true;
}

Vec3 normal_of(const Lathe& shape, Vec3 p, int part) {
  const Lathe::Ring &a = shape.rings[part], &b = shape.rings[part + 1];
  const float share = clamp01((p.y - a.y) / (b.y - a.y));
  const float outward = mix(a.normal_radius, b.normal_radius, share), up = mix(a.normal_y, b.normal_y, share);
  const float radius = std::max(std::hypot(p.x, p.z), 1e-9f);
  return normalised({outward * p.x / radius, up, outward * p.z / radius});
}

struct Extent {
  Vec3 centre;
  float radius;
};
Extent extent_of(const Ellipsoid& shape) { return {{}, std::max({shape.radii.x, shape.radii.y, shape.radii.z})}; }
Extent extent_of(const Panel& shape) { return {{}, std::hypot(shape.half_x, shape.half_z)}; }
Extent extent_of(const Lathe& shape) {
  const auto [low, high] = std::minmax_element(shape.rings.begin(), shape.rings.end(),
                                               [](const auto& a, const auto& b) { return a.y < b.y; });
  const float middle = (low->y + high->y) / 2;
  float radius = 0;
  for (const Lathe::Ring& ring : shape.rings) radius = std::max(radius, std::hypot(ring.radius, ring.y - middle));
  return {{0, middle, 0}, radius};
}

/// Point of a Catmull–Rom curve between the second and third of four numbers.
float between(float a, float b, float c, float d, float s) {
  return b + 0.5f * s * (c - a + s * (2 * a - 5 * b + 4 * c - d + s * (3 * (b - c) + d - a)));
}

}  // namespace

bool find_hit(const Object& object, const Ray& ray, Hit& hit) {
  // Past the bounding sphere, or behind what is known to be nearer.
  const Vec3 to_centre = object.bound_centre - ray.origin;
  const float along = dot(ray.direction, ray.direction), start = dot(to_centre, ray.direction) / along;
  const Vec3 nearest = ray.origin + ray.direction * start;
  const Vec3 off = nearest - object.bound_centre;
  const float spare = object.bound_radius * object.bound_radius - dot(off, off);
  if (spare < 0) return false;
  const float half_way = std::sqrt(spare / along);
  if (start - half_way > hit.distance) return false;

  LocalRay local{object.pose.point_in(nearest), object.pose.direction_in(ray.direction), start, overlap};
  local.half_height += half_way * std::abs(local.direction.y);
  return std::visit([&](const auto& shape) { return find_hit(shape, local, hit); }, object.shape);
}

Vec3 normal_at(const Object& object, Vec3 p, int part) {
  if (const auto* ellipsoid = std::get_if<Ellipsoid>(&object.shape)) {
    const Vec3 r = ellipsoid->radii;
    return normalised({p.x / (r.x * r.x), p.y / (r.y * r.y), p.z / (r.z * r.z)});
  }
  if (const auto* lathe = std::get_if<Lathe>(&object.shape)) return normal_of(*lathe, p, part);
  return {0, 1, 0};
}

Lathe make_lathe(const std::vector<std::array<float, 2>>& profile, int steps_between) {
  Lathe lathe;
  const int last = static_cast<int>(profile.size()) - 1;
  const auto at = [&](int i, int k) { return profile[std::clamp(i, 0, last)][k]; };
  for (int i = 0; i < last; ++i) {
    for (int step = 0; step < steps_between + (i == last - 1); ++step) {
      const float s = static_cast<float>(step) / static_cast<float>(steps_between);
      const float radius = between(at(i - 1, 0), at(i, 0), at(i + 1, 0), at(i + 2, 0), s);
      float y = between(at(i - 1, 1), at(i, 1), at(i + 1, 1), at(i + 2, 1), s);
      // A cone cannot be flat.
      if (!lathe.rings.empty() && std::abs(y - lathe.rings.back().y) < 1e-5f) y = lathe.rings.back().y + 1e-5f;
      lathe.rings.push_back({std::max(radius, 0.f), y, 0, 0});
    }
  }
  auto& rings = lathe.rings;
  for (std::size_t i = 0; i < rings.size(); ++i) {
    const auto &before = rings[i > 0 ? i - 1 : 0], &after = rings[std::min(i + 1, rings.size() - 1)];
    const float rise = after.y - before.y, widening = after.radius - before.radius;
    const float size = std::max(std::hypot(rise, widening), 1e-9f);
    rings[i].normal_radius = rise / size;
    rings[i].normal_y = -widening / size;
  }
  return lathe;
}

void set_bounds(Object& object) {
  const Extent extent = std::visit([](const auto& shape) { return extent_of(shape); }, object.shape);
  object.bound_centre = object.pose.origin + object.pose.direction_out(extent.centre);
  object.bound_radius = extent.radius * 1.0001f + 1e-6f;
}

}  // namespace wheatstone::still
