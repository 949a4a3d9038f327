#include "pictures_in_folder.h"

#include <algorithm>
#include <cctype>
#include <iterator>
#include <string>

namespace wheatstone::cli {
namespace {

bool is_picture(const std::filesystem::path& path) {
  constexpr const char* endings[] = {".png", ".jpg", ".jpeg", ".tif", ".tiff", ".webp", ".ppm", ".bmp"};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return std::ranges::find(endings, ending) != std::end(endings);
}

}  // namespace

std::vector<std::filesystem::path> pictures_in_folder(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const std::filesystem::directory_entry& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file() && is_picture(entry.path())) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

}  // namespace wheatstone::cli
