#include "wheatstone/video/film_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <set>

#include "wheatstone/error.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) { return is_picture_name(path) || ending_of(path) == ".exr"; }

/// "left_%04d.png" of "left_0012.png"; empty where the name has no number before its ending.
std::string pattern_of(const fs::path& file) {
  std::string before = file.stem().string();
  const auto is_digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::size_t digits = 0;
  while (digits < before.size() && is_digit(before[before.size() - 1 - digits])) ++digits;
  before.resize(before.size() - digits);
  if (digits == 0 || before.find('%') != std::string::npos) return {};
  return fmt::format("{}%0{}d{}", before, digits, file.extension().string());
}

/// The names of numbered pictures in a folder.
std::set<std::string> patterns_in(const fs::path& folder) {
  std::set<std::string> patterns;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || !is_picture(entry.path())) continue;
    const std::string pattern = pattern_of(entry.path().filename());
    if (!pattern.empty()) patterns.insert(pattern);
  }
  return patterns;
}

FilmFiles find_in_folder(const fs::path& folder, std::optional<StereoLayout> layout) {
  const std::set<std::string> patterns = patterns_in(folder);
  if (patterns.empty())
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no numbered pictures, expected a film's", folder.string()));
  for (const std::string& pattern : patterns) {
    if (!pattern.starts_with("left_%")) continue;
    const std::string right = "right" + pattern.substr(4);
    if (patterns.contains(right)) return {folder / pattern, folder / right, {}};
    return find_film((folder / pattern).string(), layout);
  }
  if (patterns.size() > 1)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has numbered pictures of {} names ({}, {}), expected one, or left_ and right_",
                            folder.string(), patterns.size(), *patterns.begin(), *std::next(patterns.begin())));
  return find_film((folder / *patterns.begin()).string(), layout);
}

}  // namespace

FilmFiles find_film(const std::string& argument, std::optional<StereoLayout> layout) {
  if (fs::is_directory(argument)) return find_in_folder(argument, layout);
  const std::size_t comma = argument.find(',');
  if (comma != std::string::npos && !fs::exists(argument))
    return {argument.substr(0, comma), argument.substr(comma + 1), {}};
  // Of OpenEXR files, the views tell.
  if (!layout && frame_pattern(argument) && fs::path(argument).extension() != ".exr") layout = StereoLayout::mono;
  return {argument, {}, layout};
}

StereoFilmReader open_film(const FilmFiles& film, const FilmReaderOptions& options) {
  return film.right.empty() ? open_stereo_film(film.film, film.layout, options)
                            : open_eye_films(film.film, film.right, options);
}

bool is_film(const std::filesystem::path& path) {
  constexpr const char* endings[] = {".mp4", ".m4v",  ".mov", ".mkv", ".mk3d", ".webm", ".avi",
                                     ".mpg", ".mpeg", ".m2v", ".ts",  ".m2ts", ".wmv",  ".flv",
                                     ".ogv", ".mxf",  ".nut", ".y4m", ".dv",   ".h264", ".hevc"};
  return std::ranges::find(endings, ending_of(path)) != std::end(endings) || frame_pattern(path).has_value();
}

}  // namespace wheatstone
