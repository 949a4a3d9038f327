#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/progress.h"
#include "wheatstone/video/film_writer.h"

namespace wheatstone {

/// The segments 0 .. count − 1 of a folder.
struct Segments {
  std::filesystem::path folder;
  std::int64_t count = 0;
};

/// Makes one film of segments, without coding again, with the options' layout and side streams. Throws
/// Error{bad_input} where a segment is damaged or was coded otherwise than the first.
void join_segments(const Segments& segments, const std::filesystem::path& film, const FilmWriterOptions& options,
                   std::vector<std::string>& notes, const Progress& progress);

}  // namespace wheatstone
