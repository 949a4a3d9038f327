#pragma once

#include <filesystem>
#include <functional>
#include <span>

#include "content.h"
#include "wheatstone/progress.h"

namespace wheatstone::viewer {

/// Takes what can be shown already of something that is not ready.
using ShowFirst = std::function<void(Opened)>;

/// Opens what a file holds: a painting (.wst), a stereo photograph of two files or one, one picture with its depth, a
/// quilt, the views of a multi-view OpenEXR, slices, particles or a film. Two files are the eyes of one photograph.
/// `show` is given a stereo photograph as it came, before it is rectified. Particles are read to show `quantity`; those
/// of a pattern, "snap_%03d.hdf5", are a series. Throws Error that names the file.
Opened open_content(std::span<const std::filesystem::path> files, const Progress& progress = {},
                    const ShowFirst& show = {}, const std::string& quantity = {});

/// Whether two files are the eyes of one photograph: two pictures, each of one view, that show one scene. `show` is
/// given two pictures of one size before it is known.
bool are_eyes_of_one(const std::filesystem::path& left, const std::filesystem::path& right, const ShowFirst& show = {});

}  // namespace wheatstone::viewer
