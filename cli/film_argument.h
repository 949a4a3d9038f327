#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "options.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone::cli {

inline constexpr std::string_view how_to_continue_film = "use --resume to continue that run";

/// A stereo layout by its name.
Value film_layout(std::optional<StereoLayout>& layout);

/// How a film is coded: --codec, --crf, --preset and --pixel-format.
Rows film_coding_rows(FilmWriterOptions& writing);

/// --projection, the sphere that a film lies on.
Row projection_row(FilmWriterOptions& writing, Reasons unless = {});

/// What is copied from the source: --no-audio and --no-subtitles.
Rows side_stream_rows(FilmWriterOptions& writing);

/// How a film that was stopped is continued: --resume and --checkpoint.
Rows film_resume_rows(bool& resume, int& frames_between_checkpoints);

/// Has a run that is ended say what it keeps of the film, and of its marks where there are any, and how to continue.
void tell_what_film_keeps(const std::filesystem::path& output, const std::filesystem::path& marks = {});

/// What `make` gives; an UnfinishedFilm that it throws becomes an Error that says how to continue.
template <class Make>
auto make_or_say_how_to_continue(Make make) {
  try {
    return make();
  } catch (const UnfinishedFilm& error) {
    throw Error(error.kind(), fmt::format("{}; {}", error.what(), how_to_continue_film));
  }
}

}  // namespace wheatstone::cli
