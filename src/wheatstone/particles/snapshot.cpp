#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "wheatstone/error.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {

int snapshot_type(const std::string& name) {
  constexpr std::array<const char*, 6> names{"gas", "halo", "disk", "bulge", "stars", "bndry"};
  const auto* const found = std::ranges::find(names, name);
  if (found != names.end()) return static_cast<int>(found - names.begin());
  if (name.size() == 1 && name[0] >= '0' && name[0] <= '5') return name[0] - '0';
  throw Error(ErrorKind::wrong_usage,
              fmt::format("the particle type is '{}', expected gas, halo, disk, bulge, stars, bndry or 0 to 5", name));
}

std::vector<std::filesystem::path> snapshot_files(const std::filesystem::path& path, int count) {
  if (count <= 1) return {path};
  // The number stands at the end of the name, or before its ending: "snap.0", "snap.0.hdf5".
  const std::string name = path.filename().string();
  const std::string ending = path.extension() == ".hdf5" || path.extension() == ".h5" ? path.extension().string() : "";
  const std::string stem = name.substr(0, name.size() - ending.size());
  const std::size_t dot = stem.rfind('.');
  const bool numbered = dot != std::string::npos && dot + 1 < stem.size() &&
                        stem.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  if (!numbered)
    throw Error(
        ErrorKind::bad_input,
        fmt::format("{}: is one of {} files of a snapshot, expected a file number in its name", path.string(), count));
  std::vector<std::filesystem::path> files;
  for (int i = 0; i < count; ++i) {
    files.push_back(path.parent_path() / fmt::format("{}.{}{}", stem.substr(0, dot), i, ending));
    if (!std::filesystem::is_regular_file(files.back()))
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: is missing, expected all {} files of this snapshot", files.back().string(), count));
  }
  return files;
}

}  // namespace wheatstone
