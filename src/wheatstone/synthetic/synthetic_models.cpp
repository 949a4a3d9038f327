#include "wheatstone/synthetic/synthetic_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "wheatstone/models/model.h"
#include "wheatstone/random.h"

namespace wheatstone {
namespace {

using Point3 = std::array<double, 3>;

constexpr double full_turn = 2 * std::numbers::pi;

Point3 sum_of(const Point3& a, const Point3& b, double times) {
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}
Point3 crossed(const Point3& a, const Point3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point3 of_unit_length(const Point3& v) {
  const double length = std::hypot(v[0], v[1], v[2]);
  return {v[0] / length, v[1] / length, v[2] / length};
}

/// Numbers from 0 to 1, the same in every run.
class HashedNumbers {
 public:
  explicit HashedNumbers(std::uint64_t seed) : key_(seed - 2 * step) {}
  double operator()() { return static_cast<double>(hash_keys({key_ += step}) >> 11) * 0x1p-53; }

 private:
  static constexpr std::uint64_t step = 0x9e3779b97f4a7c15u;
  std::uint64_t key_;
};

std::uint32_t add_vertex(Model& model, const Point3& position, const Point3& normal) {
  model.positions.push_back(position);
  model.normals.push_back(
      {static_cast<float>(normal[0]), static_cast<float>(normal[1]), static_cast<float>(normal[2])});
  return static_cast<std::uint32_t>(model.positions.size() - 1);
}

void add_triangle(Model& model, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t material = 0) {
  model.triangles.push_back({a, b, c});
  model.material_of.push_back(material);
}

/// The triangles between two rows of vertices that follow each other.
void add_strip(Model& model, std::uint32_t row, std::uint32_t next_row, std::uint32_t count) {
  for (std::uint32_t i = 0; i + 1 < count; ++i) {
    add_triangle(model, row + i, next_row + i, row + i + 1);
    add_triangle(model, row + i + 1, next_row + i, next_row + i + 1);
  }
}

Rgb8 rainbow(double share) {
  const auto channel = [&](double shift) {
    return static_cast<std::uint8_t>(std::lround(150 + 95 * std::cos(full_turn * (share + shift))));
  };
  return {channel(0), channel(0.33), channel(0.67)};
}

Point3 on_knot(double t) {
  const double ring = 2 + std::cos(3 * t);
  return {ring * std::cos(2 * t), ring * std::sin(2 * t), std::sin(3 * t)};
}

}  // namespace

Model make_knot(std::size_t triangles) {
  const auto around = std::max(8u, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 24)));
  const auto along = std::max(60u, static_cast<std::uint32_t>(triangles / (std::size_t{2} * around)));
  Model model;
  model.materials.push_back({"paint", {1, 1, 1}});
  for (std::uint32_t i = 0; i <= along; ++i) {
    const double t = full_turn * (i % along) / along;
    const Point3 middle = on_knot(t);
    const Point3 forwards = of_unit_length(sum_of(on_knot(t + 1e-4), middle, -1));
    const Point3 outwards = of_unit_length(crossed(forwards, {0, 0, 1}));
    const Point3 upwards = crossed(outwards, forwards);
    for (std::uint32_t k = 0; k <= around; ++k) {
      const double angle = full_turn * (k % around) / around;
      Point3 normal{};
      for (std::size_t axis = 0; axis < 3; ++axis)
        normal[axis] = std::cos(angle) * outwards[axis] + std::sin(angle) * upwards[axis];
      add_vertex(model, sum_of(middle, normal, 0.42), normal);
      model.colours.push_back(rainbow(3. * i / along));
    }
    if (i > 0) add_strip(model, (i - 1) * (around + 1), i * (around + 1), around + 1);
  }
  return model;
}

Model make_textured_sphere(std::size_t triangles) {
  const auto rows = std::max(8u, static_cast<std::uint32_t>(std::sqrt(static_cast<double>(triangles) / 4)));
  const std::uint32_t columns = 2 * rows;
  Model model;
  model.materials.push_back({"map", {1, 1, 1}, 0});
  for (std::uint32_t row = 0; row <= rows; ++row) {
    const double latitude = std::numbers::pi * row / rows;
    for (std::uint32_t column = 0; column <= columns; ++column) {
      const double longitude = full_turn * (column % columns) / columns;
      const double ring = row == 0 || row == rows ? 0 : std::sin(latitude);
      const Point3 normal{ring * std::cos(longitude), ring * std::sin(longitude), std::cos(latitude)};
      add_vertex(model, normal, normal);
      model.texture_places.push_back({static_cast<float>(column) / static_cast<float>(columns),
                                      1 - static_cast<float>(row) / static_cast<float>(rows)});
    }
    if (row > 0) add_strip(model, (row - 1) * (columns + 1), row * (columns + 1), columns + 1);
  }
  Image<Rgb8> map(512, 256);
  for (int y = 0; y < map.height(); ++y)
    for (int x = 0; x < map.width(); ++x)
      map(x, y) = (x / 32 + y / 32) % 2 == 0 ? rainbow(x / 512.) : Rgb8{240, static_cast<std::uint8_t>(y), 60};
  model.textures.push_back(std::move(map));
  return model;
}

Model make_city(std::size_t triangles, std::uint64_t seed) {
  constexpr std::size_t triangles_a_box = 12;
  const auto side = std::max(4, static_cast<int>(std::sqrt(static_cast<double>(triangles) / triangles_a_box)));
  Model model;
  model.materials = {
      {"houses", {0.9f, 0.85f, 0.8f}, 0}, {"roofs", {0.5f, 0.25f, 0.2f}}, {"ground", {0.3f, 0.35f, 0.3f}}};
  Image<Rgb8> windows(32, 32, {200, 190, 175});
  for (int y = 6; y < 26; ++y)
    for (int x = 8; x < 24; ++x) windows(x, y) = {60, 75, 100};
  model.textures.push_back(std::move(windows));
  HashedNumbers random(seed);
  const auto add_face = [&](const Point3& corner, const Point3& across, const Point3& up, double repeats_across,
                            double repeats_up, std::uint32_t material) {
    const Point3 normal = of_unit_length(crossed(across, up));
    const std::uint32_t first = static_cast<std::uint32_t>(model.positions.size());
    for (const auto& [u, v] : {std::pair{0., 0.}, {1., 0.}, {1., 1.}, {0., 1.}}) {
      add_vertex(model, sum_of(sum_of(corner, across, u), up, v), normal);
      model.texture_places.push_back({static_cast<float>(u * repeats_across), static_cast<float>(v * repeats_up)});
    }
    add_triangle(model, first, first + 1, first + 2, material);
    add_triangle(model, first, first + 2, first + 3, material);
  };
  for (int i = 0; i < side; ++i) {
    for (int j = 0; j < side; ++j) {
      const double width = 0.5 + 0.3 * random(), depth = 0.5 + 0.3 * random();
      const double height = 0.4 + 3 * std::pow(random(), 3);
      const Point3 at{i - side / 2., j - side / 2., 0};
      const Point3 x{width, 0, 0}, y{0, depth, 0}, z{0, 0, height};
      const Point3 left{0, -depth, 0}, back{-width, 0, 0};
      const double floors = std::max(1., std::round(height / 0.25)), rooms = std::round(width / 0.2);
      add_face(at, x, z, rooms, floors, 0);
      add_face(sum_of(at, x, 1), y, z, rooms, floors, 0);
      add_face(sum_of(sum_of(at, x, 1), y, 1), back, z, rooms, floors, 0);
      add_face(sum_of(at, y, 1), left, z, rooms, floors, 0);
      add_face(sum_of(at, z, 1), x, y, 1, 1, 1);
    }
  }
  const double half = side / 2. + 1;
  add_face({-half, -half, 0}, {2 * half, 0, 0}, {0, 2 * half, 0}, 1, 1, 2);
  return model;
}

Model make_tree(std::size_t triangles, std::uint64_t seed) {
  Model model;
  model.materials.push_back({"tree", {1, 1, 1}});
  HashedNumbers random(seed);
  const auto add_branch = [&](const Point3& from, const Point3& to, double radius, double end_radius) {
    const Point3 along = of_unit_length(sum_of(to, from, -1));
    const Point3 side = of_unit_length(crossed(along, std::abs(along[2]) < 0.9 ? Point3{0, 0, 1} : Point3{1, 0, 0}));
    const Point3 other = crossed(along, side);
    constexpr std::uint32_t around = 12;
    const std::uint32_t first = static_cast<std::uint32_t>(model.positions.size());
    for (const bool is_end : {false, true}) {
      for (std::uint32_t k = 0; k <= around; ++k) {
        const double angle = full_turn * (k % around) / around;
        Point3 normal{};
        for (std::size_t axis = 0; axis < 3; ++axis)
          normal[axis] = std::cos(angle) * side[axis] + std::sin(angle) * other[axis];
        add_vertex(model, sum_of(is_end ? to : from, normal, is_end ? end_radius : radius), normal);
        model.colours.push_back({110, 80, 55});
      }
    }
    add_strip(model, first, first + around + 1, around + 1);
  };
  add_branch({0, 0, 0}, {0, 0, 3}, 0.22, 0.12);
  std::vector<Point3> ends;
  for (int i = 0; i < 40; ++i) {
    const double height = 1.2 + 1.8 * random(), turn = full_turn * random(), reach = 0.6 + 0.9 * random();
    const Point3 from{0, 0, height};
    const Point3 to{reach * std::cos(turn), reach * std::sin(turn), height + 0.3 + 0.6 * random()};
    add_branch(from, to, 0.06, 0.02);
    for (const double share : {0.6, 0.8, 1.}) ends.push_back(sum_of(from, sum_of(to, from, -1), share));
  }
  const std::size_t leaves = triangles > model.triangles.size() ? (triangles - model.triangles.size()) / 2 : 0;
  const double size = std::clamp(8 / std::sqrt(static_cast<double>(leaves) + 1), 0.008, 0.12);
  for (std::size_t i = 0; i < leaves; ++i) {
    const Point3& end = ends[static_cast<std::size_t>(random() * static_cast<double>(ends.size())) % ends.size()];
    Point3 place{}, across{}, up{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      place[axis] = end[axis] + 0.5 * (random() + random() + random() - 1.5);
      across[axis] = random() - 0.5;
      up[axis] = random() - 0.5;
    }
    across = of_unit_length(across);
    const Point3 normal = of_unit_length(crossed(across, up));
    up = crossed(normal, across);
    const auto shade = static_cast<std::uint8_t>(90 + 110 * random());
    const std::uint32_t first = static_cast<std::uint32_t>(model.positions.size());
    for (const auto& [u, v] : {std::pair{-1., 0.}, {0., -0.5}, {1., 0.}, {0., 0.5}}) {
      add_vertex(model, sum_of(sum_of(place, across, u * size), up, v * size), normal);
      model.colours.push_back({static_cast<std::uint8_t>(shade / 2), shade, 40});
    }
    add_triangle(model, first, first + 1, first + 2);
    add_triangle(model, first, first + 2, first + 3);
  }
  return model;
}

}  // namespace wheatstone
