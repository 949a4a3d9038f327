#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/models/model.h"
#include "wheatstone/number_range.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// Which axis of a file is up. Models in OBJ and glTF files have y up and z towards the viewer by convention, those in
/// PLY and STL files z up.
enum class UpAxis { by_format, y, z };

/// How a file becomes a model.
struct ModelChoice {
  UpAxis up = UpAxis::by_format;
  /// Where a file has no normals: triangles that meet at a larger angle have an edge between them.
  float crease_deg = 60;
  bool textures = true;           ///< false: leave them out
  std::filesystem::path texture;  ///< a picture for all that has places in a texture; empty: the file's own
};

inline constexpr NumberRange crease_range_deg{0, 180};

/// What a file of a model holds, and what became of it.
struct ReadModel {
  Model model;
  std::string format;  ///< "OBJ", "PLY", "STL", "glTF"
  std::uint64_t bytes = 0;
  std::uint64_t degenerate = 0;       ///< triangles left out: two corners in one place, or all on a line
  bool has_normals = false;           ///< of its own; else they were made
  std::vector<std::string> warnings;  ///< of files that are missing, in words for people
};

/// Whether a file holds triangles by its content, whatever its name: OBJ, PLY with faces, STL or glTF 2; not where it
/// cannot be read.
bool holds_model(const std::filesystem::path& path);

/// Whether a file's name ends as those of models do that hold nothing else: .obj, .stl, .glb, .gltf.
bool is_named_as_model(const std::filesystem::path& path);

/// Whether a file is a model, by its name or its content.
inline bool is_model(const std::filesystem::path& path) { return is_named_as_model(path) || holds_model(path); }

/// Reads the triangles of a model. They are placed as its scene has them, y up becomes z up, polygons become triangles,
/// and normals are made where there are none. The file is read in a child process with limits of memory and time, and
/// textures only from its folder. Throws Error{bad_input} that names the file where it is damaged, has no triangles,
/// names vertices that it does not have, has a coordinate that is not finite or beyond 1e18, or a texture is missing.
ReadModel read_model(const std::filesystem::path& path, const ModelChoice& choice = {}, const Progress& progress = {});

}  // namespace wheatstone
