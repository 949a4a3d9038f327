#pragma once

#include <filesystem>
#include <vector>

#include "wheatstone/app/shots_file.h"
#include "wheatstone/progress.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone {

/// Finds the cuts of a film, as rotoscope_frame does, and its dissolves (motion/find_dissolve.h), after which another
/// shot begins, and writes a shots file of it. Beside "shots.toml" lies a small
/// picture of the frame in the middle of each shot, "shots_001.jpg". Throws Error{wrong_usage} where the file exists,
/// because people edit it, or its name does not end in ".toml"; Error{bad_input} where the film has no frame, or is
/// damaged, and as open_film; Error{cannot_read_write}.
std::vector<FoundShot> list_shots(const FilmFiles& film, const FilmReaderOptions& reading,
                                  const std::filesystem::path& output, const Progress& progress = {});

}  // namespace wheatstone
