#include "wheatstone/models/assemble_model_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "wheatstone/error.h"
#include "wheatstone/image/colour.h"

namespace wheatstone {
namespace {

constexpr double farthest_coordinate = 1e18;
/// What the importer gives to triangles of which the file names no material.
constexpr std::string_view importers_material = "DefaultMaterial";

class Assembler {
 public:
  Assembler(const std::filesystem::path& path, bool y_up, bool linear_colours, ReadModel& read)
      : path_(path), y_up_(y_up), linear_colours_(linear_colours), read_(read) {}

  void add(const RawModel& raw) {
    for (const RawMesh& mesh : raw.meshes) {
      has_normals_ = has_normals_ && (mesh.triangles.empty() || !mesh.normals.empty());
      has_places_ = has_places_ || !mesh.texture_places.empty();
      has_colours_ = has_colours_ || !mesh.colours.empty();
    }
    for (const RawMesh& mesh : raw.meshes) add(mesh, std::max<std::size_t>(raw.materials.size(), 1));
    if (read_.model.triangles.empty()) {
      refuse(read_.degenerate > 0
                 ? fmt::format("has only triangles without an area, {}, expected some with one", read_.degenerate)
                 : "has no triangles, expected some");
    }
    read_.has_normals = has_normals_;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path_.string(), why));
  }

  /// y up and z to the front become z up and x to the front, from where the camera looks by default.
  template <class Number>
  std::array<Number, 3> turned(const std::array<Number, 3>& v) const {
    return y_up_ ? std::array<Number, 3>{v[2], v[0], v[1]} : v;
  }

  void check(const RawMesh& mesh, std::size_t materials) const {
    const auto fits = [&](const auto& column) { return column.empty() || column.size() == mesh.positions.size(); };
    if (!fits(mesh.normals) || !fits(mesh.texture_places) || !fits(mesh.colours) || mesh.material >= materials)
      refuse("is damaged: its parts do not fit together");
    for (const auto& position : mesh.positions)
      for (const double coordinate : position)
        if (!(std::abs(coordinate) <= farthest_coordinate))
          refuse(fmt::format("a vertex has the coordinate {}, expected a number from -1e18 to 1e18", coordinate));
    for (const auto& triangle : mesh.triangles)
      for (const std::uint32_t vertex : triangle)
        if (vertex >= mesh.positions.size())
          refuse(fmt::format("a triangle has the vertex {}, expected one of {}", vertex, mesh.positions.size()));
  }

  Rgb8 colour_of(const std::array<float, 3>& colour) const {
    const auto code = [&](float value) {
      if (linear_colours_) return srgb_from_linear(value);
      return static_cast<std::uint8_t>(std::lround(255 * std::clamp(std::isnan(value) ? 0.f : value, 0.f, 1.f)));
    };
    return {code(colour[0]), code(colour[1]), code(colour[2])};
  }

  void add_vertex(const RawMesh& mesh, std::size_t v) {
    Model& model = read_.model;
    model.positions.push_back(turned(mesh.positions[v]));
    if (has_normals_) {
      std::array<float, 3> normal = turned(mesh.normals[v]);
      const float length = std::hypot(normal[0], normal[1], normal[2]);
      for (float& part : normal) part /= length;
      if (!std::isfinite(normal[0]) || !std::isfinite(normal[1]) || !std::isfinite(normal[2])) bad_normals_ = true;
      model.normals.push_back(normal);
    }
    if (has_places_) {
      std::array<float, 2> place = mesh.texture_places.empty() ? std::array<float, 2>{} : mesh.texture_places[v];
      // Farther out, places in a texture that repeats cannot be told apart.
      for (float& part : place)
        if (!(std::abs(part) < 1e6f)) part = 0;
      model.texture_places.push_back(place);
    }
    if (has_colours_) model.colours.push_back(mesh.colours.empty() ? Rgb8{255, 255, 255} : colour_of(mesh.colours[v]));
  }

  bool has_area(const std::array<std::uint32_t, 3>& triangle) const {
    const auto& positions = read_.model.positions;
    const auto &a = positions[triangle[0]], &b = positions[triangle[1]], &c = positions[triangle[2]];
    std::array<double, 3> u{}, w{};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      u[axis] = b[axis] - a[axis];
      w[axis] = c[axis] - a[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
      if (u[i] * w[j] - u[j] * w[i] != 0) return true;
    }
    return false;
  }

  void add(const RawMesh& mesh, std::size_t materials) {
    check(mesh, materials);
    if (mesh.triangles.empty()) return;
    Model& model = read_.model;
    const std::size_t first = model.positions.size();
    if (first + mesh.positions.size() > std::numeric_limits<std::uint32_t>::max() / 4)
      refuse(fmt::format("has more than {} vertices", std::numeric_limits<std::uint32_t>::max() / 4));
    for (std::size_t v = 0; v < mesh.positions.size(); ++v) add_vertex(mesh, v);
    for (std::array<std::uint32_t, 3> triangle : mesh.triangles) {
      for (std::uint32_t& vertex : triangle) vertex += static_cast<std::uint32_t>(first);
      if (!has_area(triangle)) {
        ++read_.degenerate;
        continue;
      }
      model.triangles.push_back(triangle);
      model.material_of.push_back(mesh.material);
    }
    if (bad_normals_) has_normals_ = false;
  }

  const std::filesystem::path& path_;
  bool y_up_, linear_colours_;
  bool has_normals_ = true, has_places_ = false, has_colours_ = false, bad_normals_ = false;
  ReadModel& read_;
};

}  // namespace

void assemble_model(const RawModel& raw, const ModelFormat& format, const std::filesystem::path& path,
                    const ModelChoice& choice, ReadModel& read) {
  const bool is_y_up = choice.up == UpAxis::by_format ? format.y_up : choice.up == UpAxis::y;
  Assembler(path, is_y_up, format.linear_colours, read).add(raw);
  Model& model = read.model;
  for (const RawMaterial& material : raw.materials) {
    ModelMaterial& made = model.materials.emplace_back();
    made.name = material.name;
    if (made.name == importers_material) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const float value = std::isfinite(material.colour[c]) ? std::clamp(material.colour[c], 0.f, 1.f) : 1.f;
      made.colour[c] =
          format.linear_colours ? value : linear_from_srgb(static_cast<std::uint8_t>(std::lround(255 * value)));
    }
  }
  if (model.materials.empty()) model.materials.emplace_back();
  if (!read.has_normals) make_normals(model, choice.crease_deg);
}

}  // namespace wheatstone
