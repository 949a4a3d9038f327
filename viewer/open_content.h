#pragma once

#include <filesystem>
#include <span>

#include "content.h"
#include "wheatstone/progress.h"

namespace wheatstone::viewer {

/// Opens what a file holds: a painting (.wst), a stereo photograph of two files or one, one picture with its depth, a
/// quilt, the views of a multi-view OpenEXR, slices, particles or a film. Two files are the eyes of one photograph.
/// Throws Error that names the file.
Opened open_content(std::span<const std::filesystem::path> files, const Progress& progress = {});

/// Whether two files are the eyes of one photograph: two pictures, each of one view, that show one scene.
bool are_eyes_of_one(const std::filesystem::path& left, const std::filesystem::path& right);

}  // namespace wheatstone::viewer
