#include "pack_film.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <optional>
#include <utility>

#include "film_argument.h"
#include "wheatstone/app/eyes_in_film.h"
#include "wheatstone/app/pack_film.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/error.h"
#include "wheatstone/files/output_paths.h"
#include "wheatstone/video/film_files.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

FilmFiles films_from(const PackFilmArguments& arguments) {
  if (arguments.files.size() > 2)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("there are {} films, expected one, or one for each eye", arguments.files.size()));
  if (arguments.files.size() == 2) return {arguments.files[0], arguments.files[1], {}};
  const std::optional<StereoLayout> layout = find_stereo_layout(arguments.layout);
  if (!layout && !arguments.layout.empty())
    throw Error(ErrorKind::wrong_usage, fmt::format("--layout: there is no layout '{}' of films, expected one of {}",
                                                    arguments.layout, stereo_layout_names()));
  return find_film(arguments.files.front(), layout);
}

EyesInFilm eyes_from(const PackFilmArguments& arguments) {
  if (arguments.to.empty())
    throw Error(ErrorKind::wrong_usage,
                "--to: says how a film is to hold both eyes, expected for example anaglyph, left-right-half, "
                "top-bottom or two-files");
  EyesInFilm eyes = find_eyes_in_film("--to", arguments.to);
  if (eyes.layout && !is_packed(*eyes.layout))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--to: is '{}', expected a layout with both eyes in one picture", arguments.to));
  return eyes;
}

}  // namespace

bool are_films(const std::vector<std::string>& files, const std::string& output) {
  if (files.size() == 1 && fs::is_directory(files.front())) return is_film(output);
  return !files.empty() && std::ranges::all_of(files, [](const std::string& file) { return is_film(file); });
}

Rows pack_film_rows(FilmWriterOptions& writing, const Reason& no_film, const Reason& writes_no_film) {
  return under("Film", join({{projection_row(writing, {no_film})},
                             under({}, film_coding_rows(writing), {writes_no_film}),
                             under({}, side_stream_rows(writing), {no_film})}));
}

Report run_pack_film(PackFilmArguments arguments, const Session& session) {
  const EyesInFilm eyes = eyes_from(arguments);
  const FilmFiles film = films_from(arguments);
  PackFilmOptions options{.writing = arguments.writing,
                          .anaglyph = eyes.anaglyph,
                          .right_film = {},
                          .swap = arguments.swap,
                          .shift_px = arguments.shift_px};
  if (eyes.two_films) {
    options.right_film = film_of_eye(arguments.output, right_eye);
    arguments.output = film_of_eye(arguments.output, left_eye).string();
  }
  for (const fs::path& output : {fs::path(arguments.output), options.right_film})
    if (!output.empty()) check_not_an_input(output, std::array{film.film, film.right});
  const FilmReaderOptions reading{.threads = session.threads,
                                  .deep = may_write_deep(arguments.output, arguments.writing)};
  StereoFilmReader source = open_film(film, reading);
  if (source.layout() == StereoLayout::mono && film.right.empty())
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has one eye, expected two (--layout says how they lie)", film.film.string()));
  if (session.verbose && film.right.empty())
    remark(session, fmt::format("layout: {} ({})", layout_name(source.layout()), source.layout_how()));
  options.writing.layout = eyes.layout.value_or(StereoLayout::mono);
  write_as_source(film.film, source.facts(), reading, options.writing);
  if (eyes.anaglyph.empty()) {
    keep_bits(source.facts(), arguments.output, options.writing);
  } else {
    keep_full_colour(options.writing);
  }
  options.expected_frames = expected_frames(source.facts(), reading);
  const std::vector<std::string> left_out = side_streams_left_out(arguments.output, options.writing);
  if (!left_out.empty()) remark(session, fmt::format("wheatstone: {}", fmt::join(left_out, "; ")));
  const PackedFilm packed = pack_film(source, arguments.output, options, session.progress);
  const std::string right = options.right_film.string();
  Report report{{{"frames", packed.frames},
                 {"packing", arguments.to},
                 {"width", packed.width},
                 {"height", packed.height},
                 {"notes", packed.notes, lines("note        ", packed.notes)},
                 {"output", arguments.output,
                  fmt::format("written to  {}{}{}", arguments.output, right.empty() ? "" : " and ", right)}}};
  if (!right.empty()) report.facts.push_back({"right_output", right});
  return report;
}

}  // namespace wheatstone::cli
