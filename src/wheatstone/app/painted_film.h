#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

// Properties that a painted film takes over from its source by default.

/// How the eyes lie in a painted frame: as in the source, where a frame can hold them so; side by side where the source
/// has a film an eye.
StereoLayout layout_of_painted_film(const StereoFilmReader& source, bool a_film_an_eye);

/// Rate, shape of pixels and colour of the source, which `film` is the file of; and its audio and subtitles, from
/// `reading.from_s` to `reading.to_s`.
void write_as_source(const std::filesystem::path& film, const FilmFacts& facts, const FilmReaderOptions& reading,
                     FilmWriterOptions& writing);

/// What the user should know of how the source was read: a sentence each.
std::vector<std::string> notes_on_reading(const FilmFacts& facts);

/// How many frames there will be, as far as the film says; 0 where it does not.
std::int64_t expected_frames(const FilmFacts& facts, const FilmReaderOptions& reading);

/// How much of a film so many of its frames are, 0 to 1, for telling progress; 0 where it does not say how long it is.
double share_of_film(const FilmFacts& facts, std::int64_t frames);

}  // namespace wheatstone
