#include "wheatstone/app/list_shots.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>

#include "wheatstone/app/film_scenes.h"
#include "wheatstone/app/frame_search_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/motion/find_dissolve.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

void check_output(const fs::path& output) {
  if (output.extension() != ".toml")
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: expected a name that ends in .toml", output.string()));
  std::error_code ignored;
  if (fs::exists(output, ignored))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: exists, and may have been edited; expected a new name", output.string()));
}

/// A small JPEG of the left eye.
std::string thumbnail_of(const Image<Rgb8>& picture) {
  constexpr int longest_px = 320, quality = 85;
  const PictureSize size = reduced_size({picture.width(), picture.height()}, longest_px);
  return encode_jpeg(reduced(picture, size), quality);
}

/// Where shots begin: with a cut, or after a dissolve.
std::vector<FoundShot> begins_of(const FilmScenes& scenes, const std::vector<FoundDissolve>& dissolves) {
  std::vector<FoundShot> shots;
  for (const std::int64_t begin : scenes.begins) shots.push_back({.begin = begin});
  for (const auto& [last_before, first_after] : dissolves)
    shots.push_back({.begin = first_after, .mixed_before = first_after - last_before - 1});
  std::ranges::sort(shots, {}, &FoundShot::begin);
  for (std::size_t i = 0; i < shots.size(); ++i)
    shots[i].frames = (i + 1 < shots.size() ? shots[i + 1].begin : scenes.frames) - shots[i].begin;
  return shots;
}

}  // namespace

std::vector<FoundShot> list_shots(const FilmFiles& film, const FilmReaderOptions& reading, const fs::path& output,
                                  const Progress& progress) {
  check_output(output);
  StereoFilmReader looked_at = open_film(film, reading);
  DissolveFinder finder;
  std::vector<FoundDissolve> dissolves;
  const auto end_scene = [&] {
    const std::vector<FoundDissolve> found = finder.end_scene();
    dissolves.insert(dissolves.end(), found.begin(), found.end());
  };
  const FilmScenes scenes = find_scenes(looked_at, {}, progress, [&](const StereoFrame& frame, bool is_cut) {
    if (is_cut) end_scene();
    finder.add(frame.left);
  });
  end_scene();
  if (const auto loss = looked_at.loss()) throw Error(ErrorKind::bad_input, *loss);
  if (scenes.frames == 0) throw Error(ErrorKind::bad_input, fmt::format("{}: has no frame", film.film.string()));

  FrameSearch frames(open_film(film, reading));
  std::vector<FoundShot> shots = begins_of(scenes, dissolves);
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < shots.size(); ++i) {
    report(progress, "making thumbnails", static_cast<double>(i) / static_cast<double>(shots.size()));
    FoundShot& shot = shots[i];
    const std::int64_t end = shot.begin + shot.frames;
    shot.thumbnail = fmt::format("{}_{:03}.jpg", output.stem().string(), i + 1);
    shot.begin_s = seconds_of(frames.at(shot.begin));
    pictures.push_back(thumbnail_of(frames.at(shot.begin + shot.frames / 2).left));
    const StereoFrame& last = frames.at(end - 1);
    shot.length_s = static_cast<double>(last.pts + last.duration) * last.time_base.value() - shot.begin_s;
  }
  for (std::size_t i = 0; i < shots.size(); ++i)
    write_whole_file(output.parent_path() / shots[i].thumbnail, pictures[i]);
  write_whole_file(output, shots_file_text(shots));
  return shots;
}

}  // namespace wheatstone
