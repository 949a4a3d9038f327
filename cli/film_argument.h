#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "wheatstone/error.h"
#include "wheatstone/stereo/stereo_layout.h"
#include "wheatstone/video/film_writer.h"
#include "wheatstone/video/segmented_film.h"

namespace wheatstone::cli {

inline constexpr std::string_view how_to_continue_film = "use --resume to continue that run";

/// The layout of a --layout option; nothing where it is empty. Throws Error{wrong_usage} that lists the names.
std::optional<StereoLayout> film_layout_option(const std::string& option, const std::string& name);

/// How a film is coded: --codec, --crf, --preset and --pixel-format, under a heading of the help.
void add_film_coding_options(CLI::App& command, FilmWriterOptions& writing, const std::string& group);

/// How a film that was stopped is gone on with: --resume and --checkpoint.
void add_film_resume_options(CLI::App& command, bool& resume, int& frames_between_checkpoints,
                             const std::string& group);

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
