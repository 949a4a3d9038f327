#pragma once

#include <filesystem>

#include "wheatstone/models/model.h"

namespace wheatstone {

/// Writes a model as an OBJ file with y up, its materials beside it (FILE.mtl) and its textures (FILE_0.png, …).
/// Colours of vertices stand behind their places, as many programs read them. Throws Error{cannot_read_write},
/// {wrong_usage} where the name does not end in .obj or has blanks or quotes in it, which the format has no way to
/// write.
void write_obj(const std::filesystem::path& path, const Model& model);

}  // namespace wheatstone
