#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace wheatstone {

// What the importer reads from a file, in plain numbers: nothing in it has been checked.

struct RawMesh {
  std::vector<std::array<double, 3>> positions;
  std::vector<std::array<float, 3>> normals;         ///< one a position, or none
  std::vector<std::array<float, 2>> texture_places;  ///< one a position, or none
  std::vector<std::array<float, 3>> colours;         ///< one a position, or none
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::uint32_t material = 0;
};

struct RawMaterial {
  std::string name;
  std::array<float, 3> colour{1, 1, 1};
  std::string texture;        ///< its file's name as the model has it; empty: none
  std::string texture_bytes;  ///< the picture's file itself, where the model holds it
};

struct RawModel {
  std::string complaint;  ///< why the importer could not read the file; empty: it could
  std::vector<RawMesh> meshes;
  std::vector<RawMaterial> materials;
  std::vector<std::string> missing;  ///< names of files that the model wants and that are not in its folder
};

/// Reads a file of a format, which is told as the ending that its files have ("obj", "ply", "stl", "glb", "gltf"). Of
/// other files only those in the model's folder are opened. Throws what the importer throws.
using ImportModel = void(const std::string& file, const std::string& format, RawModel& model);
inline constexpr auto model_module_name = "wheatstone_assimp";
inline constexpr auto import_model_name = "wheatstone_import_model";
inline constexpr std::size_t model_module_bytes = std::size_t{64} << 20;

}  // namespace wheatstone
