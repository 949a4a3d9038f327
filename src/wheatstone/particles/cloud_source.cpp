#include "wheatstone/particles/cloud_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>

#include "wheatstone/error.h"
#include "wheatstone/particles/formats_internal.h"

namespace wheatstone {
namespace {

std::string first_bytes(const std::filesystem::path& path) {
  if (std::filesystem::is_directory(path))
    throw Error(ErrorKind::bad_input, fmt::format("{}: is a folder, expected a file of particles", path.string()));
  std::ifstream file(path, std::ios::binary);
  if (!file) throw Error(ErrorKind::bad_input, fmt::format("{}: cannot be opened", path.string()));
  std::string bytes(512, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  if (bytes.empty()) throw Error(ErrorKind::bad_input, fmt::format("{}: is empty, expected particles", path.string()));
  return bytes;
}

void append(std::vector<float>& to, const std::vector<float>& more) { to.insert(to.end(), more.begin(), more.end()); }

void append(Cloud& to, const Cloud& more) {
  append(to.x, more.x);
  append(to.y, more.y);
  append(to.z, more.z);
  append(to.density, more.density);
  append(to.temperature, more.temperature);
  append(to.smoothing_length, more.smoothing_length);
  to.colour.insert(to.colour.end(), more.colour.begin(), more.colour.end());
  to.origin = more.origin;
  to.box_size = more.box_size;
}

}  // namespace

CloudSource open_cloud(const std::filesystem::path& path, const CloudChoice& choice) {
  const std::string bytes = first_bytes(path);
  if (bytes.starts_with("\x89HDF\r\n\x1a\n")) return open_hdf5_cloud(path, choice);
  if (bytes.starts_with("ply\n") || bytes.starts_with("ply\r")) return open_ply(path, choice);
  if (bytes.starts_with("LASF")) return open_las(path, choice);
  if (bytes.starts_with("\x93NUMPY")) return open_npy(path, choice);
  if (looks_like_gadget_binary(bytes)) return open_gadget_binary(path, choice);
  const bool text = std::ranges::none_of(bytes, [](char c) { return c == '\0' || (c > 0 && c < 9); });
  if (text) return open_text_table(path, choice);
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: is of no known format, expected GADGET, HDF5, PLY, LAS, NumPy or text", path.string()));
}

Cloud read_cloud(const std::filesystem::path& path, const CloudChoice& choice, const Progress& progress) {
  const CloudSource source = open_cloud(path, choice);
  constexpr std::size_t chunk = 1 << 20;
  Cloud all;
  while (true) {
    const Cloud more = source.next(chunk);
    if (more.size() == 0) break;
    append(all, more);
    if (source.count) report(progress, "reading", static_cast<double>(all.size()) / static_cast<double>(*source.count));
  }
  if (all.size() == 0) throw Error(ErrorKind::bad_input, fmt::format("{}: has no particles", path.string()));
  return all;
}

}  // namespace wheatstone
