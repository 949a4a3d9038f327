#include "wheatstone/app/list_shots.h"

#include <fmt/format.h>

#include <cstddef>
#include <string>
#include <utility>

#include "wheatstone/app/film_scenes.h"
#include "wheatstone/app/frame_search_internal.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
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

}  // namespace

std::vector<FoundShot> list_shots(const FilmFiles& film, const FilmReaderOptions& reading, const fs::path& output,
                                  const Progress& progress) {
  check_output(output);
  StereoFilmReader looked_at = open_film(film, reading);
  const FilmScenes scenes = find_scenes(looked_at, {}, progress);
  if (const auto loss = looked_at.loss()) throw Error(ErrorKind::bad_input, *loss);
  if (scenes.frames == 0) throw Error(ErrorKind::bad_input, fmt::format("{}: has no frame", film.film.string()));

  FrameSearch frames(open_film(film, reading));
  std::vector<FoundShot> shots;
  std::vector<std::string> pictures;
  for (std::size_t i = 0; i < scenes.begins.size(); ++i) {
    report(progress, "making thumbnails", static_cast<double>(i) / static_cast<double>(scenes.begins.size()));
    const std::int64_t begin = scenes.begins[i];
    const std::int64_t end = i + 1 < scenes.begins.size() ? scenes.begins[i + 1] : scenes.frames;
    FoundShot shot{.begin = begin, .frames = end - begin};
    shot.thumbnail = fmt::format("{}_{:03}.jpg", output.stem().string(), i + 1);
    const StereoFrame& first = frames.at(begin);
    shot.begin_s = seconds_of(first);
    pictures.push_back(thumbnail_of(frames.at(begin + (end - begin) / 2).left));
    const StereoFrame& last = frames.at(end - 1);
    shot.length_s = static_cast<double>(last.pts + last.duration) * last.time_base.value() - shot.begin_s;
    shots.push_back(std::move(shot));
  }
  for (std::size_t i = 0; i < shots.size(); ++i)
    write_whole_file(output.parent_path() / shots[i].thumbnail, pictures[i]);
  write_whole_file(output, shots_file_text(shots));
  return shots;
}

}  // namespace wheatstone
