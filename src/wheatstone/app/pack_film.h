#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "wheatstone/progress.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

struct PackFilmOptions {
  FilmWriterOptions writing;         ///< `layout` says how the eyes lie in a frame
  std::string anaglyph;              ///< an anaglyph_kind's name: both eyes for coloured glasses; empty: none
  std::filesystem::path right_film;  ///< of the right eye, where the output is that of the left eye; empty: one film
  bool swap = false;                 ///< the right eye's pictures are the left eye's
  float shift_px = 0;                ///< disparity that lies on the screen plane, as shifted_views
  std::int64_t expected_frames = 0;  ///< for telling how long it takes; 0: not known
};

struct PackedFilm {
  std::int64_t frames = 0;
  int width = 0, height = 0;       ///< of a written frame
  std::vector<std::string> notes;  ///< as FilmWriter
};

/// Writes a film of two eyes in another layout, or as a film for each eye, with the source's frame times. A run that
/// does not finish leaves nothing. Throws Error{bad_input} where the source has one eye, and, after the film is
/// written, where the source is damaged; and as the reader and the writer do.
PackedFilm pack_film(StereoFilmReader& source, const std::filesystem::path& output, const PackFilmOptions& options,
                     const Progress& progress = {});

}  // namespace wheatstone
