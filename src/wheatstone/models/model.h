#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// What a surface is made of.
struct ModelMaterial {
  std::string name;
  std::array<float, 3> colour{0.8f, 0.8f, 0.8f};  ///< linear light, 0..1; a factor on that of vertices and texture
  int texture = -1;                               ///< index in Model::textures; -1: none
};

/// Triangles that share vertices. z is up.
struct Model {
  /// Of a vertex: where it is, in the file's own units, the direction away from the surface, of length 1, and, where
  /// the model has them, its place in the texture (0, 0 is the lower left corner, 1, 1 the upper right) and its colour.
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<float, 3>> normals;
  std::vector<std::array<float, 2>> texture_places;  ///< empty: none
  std::vector<Rgb8> colours;                         ///< empty: none

  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< indices of vertices
  std::vector<std::uint32_t> material_of;               ///< of each triangle, an index in `materials`
  std::vector<ModelMaterial> materials;
  std::vector<Image<Rgb8>> textures;
};

/// The box around all vertices.
struct ModelBounds {
  std::array<double, 3> least{}, most{};
  std::array<double, 3> middle() const;
  std::array<double, 3> size() const;
  double radius() const;  ///< of the sphere around the box
};

/// The bounds of a model that has vertices.
ModelBounds bounds_of(const Model& model);

/// Gives every vertex a normal: the mean of the triangles around its position, by their angles there, of those that
/// meet the vertex's own triangle at no more than `crease_deg`. Vertices at creases are doubled. Where the model has no
/// other vertices at a position, 180 makes all of it smooth and 0 all of it faceted. The model's own normals are
/// replaced.
void make_normals(Model& model, float crease_deg);

}  // namespace wheatstone
