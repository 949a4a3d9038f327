#include "film_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <set>

#include "wheatstone/error.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

bool is_picture(const fs::path& path) {
  constexpr std::array endings{".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".ppm", ".bmp"};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(endings, ending) != endings.end();
}

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

StereoFilmReader open_folder(const fs::path& folder, std::optional<FilmLayout> layout) {
  const std::set<std::string> patterns = patterns_in(folder);
  if (patterns.empty())
    throw Error(ErrorKind::bad_input, fmt::format("{}: has no numbered pictures, expected a film's", folder.string()));
  for (const std::string& pattern : patterns) {
    if (!pattern.starts_with("left_%")) continue;
    const std::string right = "right" + pattern.substr(4);
    if (patterns.contains(right)) return open_eye_films(folder / pattern, folder / right);
    return open_stereo_film(folder / pattern, layout.value_or(FilmLayout::mono));
  }
  if (patterns.size() > 1)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: has numbered pictures of {} names ({}, {}), expected one, or left_ and right_",
                            folder.string(), patterns.size(), *patterns.begin(), *std::next(patterns.begin())));
  return open_stereo_film(folder / *patterns.begin(), layout.value_or(FilmLayout::mono));
}

}  // namespace

StereoFilmReader open_film_argument(const std::string& argument, std::optional<FilmLayout> layout) {
  if (fs::is_directory(argument)) return open_folder(argument, layout);
  const std::size_t comma = argument.find(',');
  if (comma != std::string::npos && !fs::exists(argument))
    return open_eye_films(argument.substr(0, comma), argument.substr(comma + 1));
  if (!layout && frame_pattern(argument)) layout = FilmLayout::mono;
  return open_stereo_film(argument, layout);
}

}  // namespace wheatstone::cli
