#include "wheatstone/app/place_shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "wheatstone/error.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone {
namespace {

/// Where a shot begins in a film: nothing before it is found.
struct Place {
  std::optional<std::int64_t> frame;  ///< counted from 1
  std::int64_t pts = 0;
};

/// Whether a shot begins with this frame, if it has not begun before.
bool begins(const WrittenShot& shot, std::int64_t number, double seconds) {
  // Times in shots files are rounded to a millisecond.
  constexpr double mercy_s = 0.0006;
  if (const auto* frame = std::get_if<std::int64_t>(&shot.begin)) return *frame == number;
  return std::get<double>(shot.begin) <= seconds + mercy_s;
}

/// Goes through a film until all shots have begun, and ended where they say so.
std::vector<Place> find_places(std::span<const WrittenShot> shots, StereoFilmReader film, const Progress& progress) {
  std::vector<Place> places(shots.size());
  std::int64_t last = 1, frames = 0;
  for (const WrittenShot& shot : shots) last = std::max(last, shot.last.value_or(1));
  // One frame more tells whether the film goes on.
  if (shots.back().last) last = std::max(last, *shots.back().last + 1);
  const auto is_found = [](const Place& place) { return place.frame.has_value(); };
  for (StereoFrame frame; (frames < last || !std::ranges::all_of(places, is_found)) && film.read(frame);) {
    report(progress, "looking for the shots", 0);
    ++frames;
    for (std::size_t i = 0; i < shots.size(); ++i)
      if (!places[i].frame && begins(shots[i], frames, seconds_of(frame))) places[i] = {frames, frame.pts};
  }
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (!places[i].frame)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: begins beyond the end of the film, which has {} frames", shots[i].where, frames));
    if (shots[i].last.value_or(1) > frames)
      throw Error(ErrorKind::bad_input, fmt::format("{}: ends with frame {}, but the film has {} frames",
                                                    shots[i].where, *shots[i].last, frames));
  }
  if (shots.back().last && *shots.back().last < frames)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: ends with frame {}, but the film goes on: every frame belongs to a shot",
                            shots.back().where, *shots.back().last));
  return places;
}

/// Every frame must belong to one shot.
void check_order(std::span<const WrittenShot> shots, std::span<const Place> places) {
  if (places.front().frame != 1)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: begins with frame {}, expected 1, because every frame belongs to "
                            "a shot",
                            shots.front().where, *places.front().frame));
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::int64_t begin = *places[i].frame;
    if (i > 0 && begin <= *places[i - 1].frame)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: begins with frame {}, expected a later one than {}, where the shot before it begins",
                              shots[i].where, begin, *places[i - 1].frame));
    if (!shots[i].last) continue;
    const std::int64_t last = *shots[i].last;
    if (last < begin)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: ends with frame {}, before its first one, {}", shots[i].where, last, begin));
    if (i + 1 == shots.size() || *places[i + 1].frame <= begin || last + 1 == *places[i + 1].frame) continue;
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: ends with frame {}, but the next shot begins with frame {}: {}", shots[i].where, last,
                            *places[i + 1].frame,
                            last < *places[i + 1].frame ? "frames between them belong to no shot" : "they overlap"));
  }
}

}  // namespace

std::vector<FilmShot> place_shots(std::span<const WrittenShot> shots, const FilmFiles& film,
                                  const FilmReaderOptions& reading, const Progress& progress) {
  FilmReaderOptions whole = reading;
  whole.from_s.reset();
  whole.to_s.reset();
  whole.every = 1;
  const std::vector<Place> places = find_places(shots, open_film(film, whole), progress);
  check_order(shots, places);
  std::vector<FilmShot> placed;
  if (!reading.from_s && !reading.to_s && reading.every == 1) {
    for (std::size_t i = 0; i < shots.size(); ++i) {
      placed.push_back(shots[i].painted);
      placed.back().begin = *places[i].frame - 1;
    }
    return placed;
  }
  // Those of which a frame is read.
  StereoFilmReader part = open_film(film, reading);
  std::size_t shot = 0;
  std::int64_t number = 0;
  for (StereoFrame frame; part.read(frame); ++number) {
    report(progress, "looking for the shots", 0);
    const std::size_t before = shot;
    while (shot + 1 < shots.size() && places[shot + 1].pts <= frame.pts) ++shot;
    if (number > 0 && shot == before) continue;
    placed.push_back(shots[shot].painted);
    placed.back().begin = number;
  }
  return placed;
}

}  // namespace wheatstone
