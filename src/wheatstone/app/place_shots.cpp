#include "wheatstone/app/place_shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "wheatstone/app/corrected_depth.h"
#include "wheatstone/app/painted_film.h"
#include "wheatstone/error.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

/// A frame that a shots file names, in a film: nothing before it is found.
struct Place {
  std::optional<std::int64_t> frame;  ///< counted from 1
  std::int64_t pts = 0;
  double seconds = 0;
};

/// Where a shot begins, and where its keys lie.
struct ShotPlace : Place {
  std::vector<Place> keys;
  Place dissolved;  ///< the first frame that belongs to the shot alone
};

/// The frame before which the last shot ends: it lasts as long as the film.
constexpr std::int64_t no_end = std::numeric_limits<std::int64_t>::max();

/// Takes the frame, if it is the first that fits.
void look(const WrittenFrame& wanted, std::int64_t number, const StereoFrame& frame, Place& place) {
  // Times in shots files are rounded to a millisecond.
  constexpr double mercy_s = 0.0006;
  if (place.frame) return;
  const auto* const wanted_number = std::get_if<std::int64_t>(&wanted);
  const bool fits =
      wanted_number != nullptr ? *wanted_number == number : std::get<double>(wanted) <= seconds_of(frame) + mercy_s;
  if (fits) place = {number, frame.pts, seconds_of(frame)};
}

/// The first frame after the dissolve of a shot that begins at `place`.
WrittenFrame end_of_dissolve(const WrittenShot& shot, const Place& place) {
  if (!shot.dissolve) return *place.frame;
  if (const auto* const frames = std::get_if<std::int64_t>(&*shot.dissolve)) return *place.frame + *frames;
  return place.seconds + std::get<double>(*shot.dissolve);
}

bool is_found(const ShotPlace& place) {
  return place.frame && place.dissolved.frame &&
         std::ranges::all_of(place.keys, [](const Place& key) { return key.frame.has_value(); });
}

/// Disparities made by hand must have the size of an eye. This is known before hours of painting.
void check_maps(std::span<const WrittenShot> shots, PictureSize eye) {
  const auto check = [&](const FrameMaps& maps, const std::string& where) {
    if (maps.disparity.empty()) return;
    try {
      read_frame_disparity(maps.disparity, eye);
    } catch (const Error& error) {
      throw Error(ErrorKind::bad_input, fmt::format("{}: {}", where, error.what()));
    }
  };
  for (const WrittenShot& shot : shots) {
    check(shot.maps, shot.where);
    for (const WrittenKey& key : shot.keys) check(key.maps, key.where);
  }
}

/// Goes through a film until all shots have begun, and ended where they say so, and all keys have been met.
std::vector<ShotPlace> find_places(std::span<const WrittenShot> shots, StereoFilmReader film,
                                   const Progress& progress) {
  std::vector<ShotPlace> places;
  for (const WrittenShot& shot : shots) places.push_back({{}, std::vector<Place>(shot.keys.size()), {}});
  std::int64_t last = 1, frames = 0;
  for (const WrittenShot& shot : shots) last = std::max(last, shot.last.value_or(1));
  // One frame more tells whether the film goes on.
  if (shots.back().last) last = std::max(last, *shots.back().last + 1);
  for (StereoFrame frame; (frames < last || !std::ranges::all_of(places, is_found)) && film.read(frame);) {
    report(progress, "looking for the shots", share_of_film(film.facts(), frames));
    if (++frames == 1) check_maps(shots, {frame.left.width(), frame.left.height()});
    for (std::size_t i = 0; i < shots.size(); ++i) {
      look(shots[i].begin, frames, frame, places[i]);
      for (std::size_t key = 0; key < shots[i].keys.size(); ++key)
        look(shots[i].keys[key].at, frames, frame, places[i].keys[key]);
      if (places[i].frame) look(end_of_dissolve(shots[i], places[i]), frames, frame, places[i].dissolved);
    }
  }
  for (std::size_t i = 0; i < shots.size(); ++i) {
    if (!places[i].frame)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: begins beyond the end of the film, which has {} frames", shots[i].where, frames));
    for (std::size_t key = 0; key < shots[i].keys.size(); ++key)
      if (!places[i].keys[key].frame)
        throw Error(ErrorKind::bad_input, fmt::format("{}: lies beyond the end of the film, which has {} frames",
                                                      shots[i].keys[key].where, frames));
    if (!places[i].dissolved.frame)
      throw Error(
          ErrorKind::bad_input,
          fmt::format("{}: its dissolve does not end before the film, which has {} frames", shots[i].where, frames));
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
void check_order(std::span<const WrittenShot> shots, std::span<const ShotPlace> places) {
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

/// A dissolve must end within its shot, before `end`.
void check_dissolve(const WrittenShot& shot, const ShotPlace& place, std::int64_t end) {
  if (shot.dissolve && place.frame == 1)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: begins with a dissolve, but there is no shot before it", shot.where));
  if (*place.dissolved.frame > end)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: its dissolve goes on to frame {}, but the shot ends with frame {}", shot.where,
                            *place.dissolved.frame - 1, end - 1));
}

/// Keys must lie in their shot, which ends before `end`, one after the other.
void check_keys(const WrittenShot& shot, const ShotPlace& place, std::int64_t end) {
  for (std::size_t i = 0; i < shot.keys.size(); ++i) {
    const std::int64_t at = *place.keys[i].frame;
    if (at < *place.frame || at >= end)
      throw Error(
          ErrorKind::bad_input,
          fmt::format("{}: lies at frame {}, outside its shot, which begins with frame {}{}", shot.keys[i].where, at,
                      *place.frame, end < no_end ? fmt::format(" and ends with frame {}", end - 1) : ""));
    if (i > 0 && at <= *place.keys[i - 1].frame)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: lies at frame {}, expected a later one than {}, where the key before it lies",
                              shot.keys[i].where, at, *place.keys[i - 1].frame));
  }
}

/// The numbers that the keys of a shot give.
std::vector<MovingParameter> moving_parameters(const WrittenShot& shot, const ShotPlace& place) {
  std::vector<MovingParameter> moving;
  for (std::size_t i = 0; i < shot.keys.size(); ++i)
    for (const WrittenKey::Value& value : shot.keys[i].values) {
      auto one = std::ranges::find(moving, value.parameter, &MovingParameter::name);
      if (one == moving.end()) one = moving.insert(one, {std::string(value.parameter), {}});
      one->keys.push_back({place.keys[i].seconds, value.value});
    }
  return moving;
}

/// What a shot has of maps, at a frame of the whole film, which has a time.
struct PlacedMaps : MapsKey {
  std::int64_t pts = 0;
};

std::vector<PlacedMaps> maps_of(const WrittenShot& shot, const ShotPlace& place) {
  std::vector<PlacedMaps> placed;
  const auto add = [&](const Place& at, const FrameMaps& maps) {
    if (!maps.empty()) placed.push_back({{*at.frame - 1, maps}, at.pts});
  };
  add(place, shot.maps);
  for (std::size_t i = 0; i < shot.keys.size(); ++i) add(place.keys[i], shot.keys[i].maps);
  return placed;
}

/// The shots as they lie in the whole film.
std::vector<FilmShot> shots_at(std::span<const WrittenShot> shots, std::span<const ShotPlace> places) {
  std::vector<FilmShot> placed;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const std::int64_t end = i + 1 < shots.size() ? *places[i + 1].frame : no_end;
    check_dissolve(shots[i], places[i], end);
    check_keys(shots[i], places[i], end);
    FilmShot& shot = placed.emplace_back(shots[i].painted);
    shot.begin = *places[i].frame - 1;
    shot.moving = moving_parameters(shots[i], places[i]);
    shot.dissolve_frames = *places[i].dissolved.frame - *places[i].frame;
    for (const PlacedMaps& placed_maps : maps_of(shots[i], places[i])) shot.maps.push_back(placed_maps);
  }
  return placed;
}

}  // namespace

std::vector<FilmShot> place_shots(std::span<const WrittenShot> shots, const FilmFiles& film,
                                  const FilmReaderOptions& reading, const Progress& progress) {
  FilmReaderOptions whole = reading;
  whole.from_s.reset();
  whole.to_s.reset();
  whole.every = 1;
  const std::vector<ShotPlace> places = find_places(shots, open_film(film, whole), progress);
  check_order(shots, places);
  std::vector<FilmShot> in_whole = shots_at(shots, places);
  if (!reading.from_s && !reading.to_s && reading.every == 1) return in_whole;
  // Those of which a frame is read.
  std::vector<FilmShot> placed;
  StereoFilmReader part = open_film(film, reading);
  std::size_t shot = 0;
  std::int64_t number = 0;
  std::vector<PlacedMaps> maps;  ///< of the shot, that are not reached yet
  for (StereoFrame frame; part.read(frame); ++number) {
    report(progress, "looking for the shots", share_of_film(part.facts(), number));
    const std::size_t before = shot;
    while (shot + 1 < shots.size() && places[shot + 1].pts <= frame.pts) ++shot;
    if (number == 0 || shot != before) {
      placed.push_back(in_whole[shot]);
      placed.back().begin = number;
      placed.back().dissolve_frames = 0;
      placed.back().maps.clear();
      maps = maps_of(shots[shot], places[shot]);
      // Where the map of a frame before the part lies now is not known.
      if (number == 0) std::erase_if(maps, [&](const PlacedMaps& one) { return one.pts < frame.pts; });
    }
    while (!maps.empty() && maps.front().pts <= frame.pts) {
      placed.back().maps.push_back({number, maps.front().maps});
      maps.erase(maps.begin());
    }
    // Nothing is known of a shot that ends before the part begins.
    if (placed.size() > 1 && frame.pts < places[shot].dissolved.pts) ++placed.back().dissolve_frames;
  }
  return placed;
}

}  // namespace wheatstone
