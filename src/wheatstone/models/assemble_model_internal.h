#pragma once

#include <filesystem>

#include "wheatstone/models/model_format_internal.h"
#include "wheatstone/models/raw_model_internal.h"
#include "wheatstone/models/read_model.h"

namespace wheatstone {

/// Checks what the importer read and makes one list of vertices and triangles of it, z up. What is known of the file
/// goes into `read`. Throws Error{bad_input} as read_model does.
void assemble_model(const RawModel& raw, const ModelFormat& format, const std::filesystem::path& path,
                    const ModelChoice& choice, ReadModel& read);

/// Reads the textures of a model's materials. Throws Error{bad_input} that names the model where one is missing, lies
/// outside the model's folder or cannot be read.
void read_textures(const RawModel& raw, const std::filesystem::path& path, const ModelChoice& choice, Model& model);

}  // namespace wheatstone
