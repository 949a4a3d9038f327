#include <fmt/format.h>

#include <cmath>

#include "wheatstone/app/film_beside_internal.h"
#include "wheatstone/error.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

void check_length(const fs::path& path, const FilmFacts& found, const MainFilm& main) {
  const FilmFacts& film = main.facts;
  if (found.frame_count && film.frame_count) {
    if (*found.frame_count != *film.frame_count)
      refuse_film_beside(path, fmt::format("has {} frames, expected {} as {}", *found.frame_count, *film.frame_count,
                                           main.film.string()));
    return;
  }
  const double frame_s = film.frame_rate.value() > 0 ? 1 / film.frame_rate.value() : 0.04;
  if (found.duration_s > 0 && film.duration_s > 0 && std::abs(found.duration_s - film.duration_s) > 1.5 * frame_s)
    refuse_film_beside(path, fmt::format("is {:.2f} s long, expected {:.2f} s as {}", found.duration_s, film.duration_s,
                                         main.film.string()));
}

/// Numbered pictures have no rate of their own.
FilmReaderOptions reading_beside(const MainFilm& main) {
  FilmReaderOptions reading = main.reading;
  if (main.facts.frame_rate.value() > 0) reading.sequence_rate = main.facts.frame_rate;
  return reading;
}

}  // namespace

void refuse_film_beside(const fs::path& path, const std::string& why) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", path.string(), why));
}

FilmBeside::FilmBeside(const fs::path& path, const MainFilm& main)
    : path_(path), main_(main.film), reader_(open_film(path, reading_beside(main))) {
  check_length(path, reader_.facts(), main);
}

const Image<Rgb8>& FilmBeside::at(std::int64_t frame) {
  if (frame > next_) next_ += reader_.skip(frame - next_);
  if (frame != next_ || !reader_.read(frame_))
    refuse_film_beside(path_, fmt::format("has {} frames, expected as many as {}", next_, main_.string()));
  ++next_;
  return frame_.picture;
}

}  // namespace wheatstone
