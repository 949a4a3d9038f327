#include "folder_items.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>
#include <system_error>
#include <utility>

#include "content.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/drawing/draw.h"
#include "wheatstone/error.h"
#include "wheatstone/marks/painting_file.h"
#include "wheatstone/photograph/find_layout.h"
#include "wheatstone/photograph/find_photographs.h"
#include "wheatstone/photograph/read_views.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/pictures/write_image.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/video/film_files.h"
#include "wheatstone/video/frame_sequence.h"

namespace wheatstone::viewer {
namespace {

namespace fs = std::filesystem;

bool is_digit(char letter) { return std::isdigit(static_cast<unsigned char>(letter)) != 0; }

/// The digits at the beginning of a text, which are taken off it, without zeros before them.
std::string_view take_number(std::string_view& text) {
  const auto digits = static_cast<std::size_t>(std::ranges::find_if_not(text, is_digit) - text.begin());
  std::string_view number = text.substr(0, digits);
  text.remove_prefix(digits);
  number.remove_prefix(std::min(number.find_first_not_of('0'), number.size()));
  return number;
}

bool is_item(const fs::path& file) {
  const std::string ending = file.extension().string();
  return is_picture_name(file) || is_stereo_file_name(file) || ending == ".wst" || ending == ".heic" ||
         ending == ".HEIC" || ending == ".avif";
}

/// Whether a file is named as the depth map of another one; `stems` are the names of all, without their endings.
bool is_depth_map(const fs::path& file, const std::set<std::string>& stems) {
  const std::string stem = file.stem().string();
  for (const std::string_view ending : {"_depth", "-depth"})
    if (stem.ends_with(ending) && stems.contains(stem.substr(0, stem.size() - ending.size()))) return true;
  return false;
}

/// Paths are those of `shown_folder` and a name; it is empty where names are relative to where the program runs.
std::vector<Item> items_of(const fs::path& folder, const fs::path& shown_folder) {
  std::error_code error;
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
    if (entry.is_regular_file(error) && is_item(entry.path()) && entry.path().filename().string().front() != '.')
      files.push_back(shown_folder / entry.path().filename());
  if (error) throw Error(ErrorKind::cannot_read_write, fmt::format("{}: {}", folder.string(), error.message()));
  std::ranges::sort(files, [](const fs::path& a, const fs::path& b) {
    return comes_before(a.filename().string(), b.filename().string());
  });
  // Each name is looked up: a folder may have thousands.
  std::set<std::string> names, stems, right_eyes;
  for (const fs::path& file : files) {
    names.insert(file.filename().string());
    stems.insert(file.stem().string());
  }
  const auto right_eyes_of = [&](const fs::path& file) {
    std::vector<std::string> found = names_of_right_eye(file.filename().string());
    std::erase_if(found, [&](const std::string& name) { return !names.contains(name); });
    return found;
  };
  for (const fs::path& file : files)
    for (std::string& name : right_eyes_of(file)) right_eyes.insert(std::move(name));
  std::vector<Item> items;
  for (const fs::path& file : files) {
    if (is_depth_map(file, stems) || right_eyes.contains(file.filename().string())) continue;
    const std::vector<std::string> right = right_eyes_of(file);
    items.push_back(right.empty() ? Item{file} : Item{file, file.parent_path() / right.front()});
  }
  return items;
}

}  // namespace

bool comes_before(std::string_view name, std::string_view other) {
  const std::string_view whole_name = name, whole_other = other;
  while (!name.empty() && !other.empty()) {
    if (is_digit(name.front()) && is_digit(other.front())) {
      const std::string_view a = take_number(name), b = take_number(other);
      if (a != b) return a.size() != b.size() ? a.size() < b.size() : a < b;
      continue;
    }
    const int a = std::tolower(static_cast<unsigned char>(name.front()));
    const int b = std::tolower(static_cast<unsigned char>(other.front()));
    if (a != b) return a < b;
    name.remove_prefix(1);
    other.remove_prefix(1);
  }
  if (name.empty() != other.empty()) return name.empty();
  return whole_name < whole_other;
}

std::vector<Item> items_in(const fs::path& folder) { return items_of(folder, folder); }

std::vector<Item> items_beside(const Item& item) {
  const fs::path folder = item.front().parent_path();
  try {
    return items_of(folder.empty() ? fs::path(".") : folder, folder);
  } catch (const Error&) {
    return {};
  }
}

std::optional<std::size_t> place_among(std::span<const Item> items, const Item& item) {
  const auto found =
      std::ranges::find_if(items, [&](const Item& one) { return std::ranges::find(one, item.front()) != one.end(); });
  return found == items.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - items.begin()));
}

bool holds_film(const fs::path& folder) {
  try {
    if (holds_photographs(folder)) return false;
    const FilmFiles film = find_film(folder.string());
    const std::optional<FramePattern> pattern = frame_pattern(film.film);
    return !film.right.empty() || !pattern || numbers_of(*pattern).size() >= 2;
  } catch (const Error&) {
    return false;
  }
}

namespace {

Image<Rgb8> picture_of(const std::filesystem::path& file) {
  if (file.extension() == ".wst") return draw(read_painting(file), left_eye).picture;
  if (const auto quilt = quilt_of_name(file.filename().string()))
    return std::move(views_of_quilt(read_image(file), quilt->layout).front());
  std::optional<ViewsFile> found = find_views(file);
  return found ? std::move(found->views.front()) : read_image(file);
}

}  // namespace

Image<Rgb8> thumbnail_of(const Item& files, PictureSize largest) {
  try {
    const Image<Rgb8> picture = picture_of(files.front());
    const double scale = std::min({static_cast<double>(largest.width) / picture.width(),
                                   static_cast<double>(largest.height) / picture.height(), 1.});
    const auto scaled = [scale](int side) { return std::max(static_cast<int>(std::lround(side * scale)), 1); };
    return reduced(picture, {scaled(picture.width()), scaled(picture.height())});
  } catch (const Error&) {
    return {};
  }
}

}  // namespace wheatstone::viewer
