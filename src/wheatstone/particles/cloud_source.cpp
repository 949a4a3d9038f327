#include "wheatstone/particles/cloud_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/particles/columns_internal.h"
#include "wheatstone/particles/formats_internal.h"
#include "wheatstone/particles/snapshot_internal.h"

namespace wheatstone {
namespace {

/// As many of a file's first bytes as tell its format.
std::string some_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes(512, '\0');
  file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  bytes.resize(static_cast<std::size_t>(file.gcount()));
  return bytes;
}

bool begins_as_ply(std::string_view bytes) { return bytes.starts_with("ply\n") || bytes.starts_with("ply\r"); }

/// A zip archive whose first file is an array.
bool begins_as_npz(std::string_view bytes) {
  constexpr std::size_t name_at = 30;
  if (!bytes.starts_with("PK\3\4") || bytes.size() < name_at) return false;
  const auto byte = [&](std::size_t at) { return std::size_t{static_cast<unsigned char>(bytes[at])}; };
  return bytes.substr(name_at, byte(26) + 256 * byte(27)).ends_with(".npy");
}

bool is_text(std::string_view bytes) {
  return std::ranges::none_of(bytes, [](char c) { return c == '\0' || (c > 0 && c < 9); });
}

/// Whether a text's first lines are those of a table with the columns of a position: numbers, or names above numbers.
bool looks_like_table(std::string_view bytes) {
  bool names_above = false;
  while (!bytes.empty()) {
    const std::size_t end = bytes.find('\n');
    const std::vector<std::string_view> fields = fields_of(bytes.substr(0, end));
    bytes.remove_prefix(end == std::string_view::npos ? bytes.size() : end + 1);
    if (fields.empty() || fields[0].starts_with('#')) continue;
    if (fields.size() < 3) return false;
    if (std::ranges::all_of(fields, [](std::string_view field) { return parse_number(field).has_value(); }))
      return true;
    if (names_above) return false;
    names_above = true;
  }
  return false;
}

/// A format, as it is told by a file's first bytes, and its reader.
struct Format {
  std::string_view name;
  bool (*begins_so)(std::string_view first_bytes);
  CloudSource (*open)(const std::filesystem::path& path, const CloudChoice& choice);
};

/// The first that fits counts.
constexpr std::array formats{
    Format{"GADGET", looks_like_gadget_binary, open_gadget_binary},
    Format{"HDF5", [](std::string_view bytes) { return bytes.starts_with("\x89HDF\r\n\x1a\n"); }, open_hdf5_cloud},
    Format{"PLY", begins_as_ply, open_ply},
    Format{"LAS", [](std::string_view bytes) { return bytes.starts_with("LASF"); }, open_las},
    Format{"NumPy", [](std::string_view bytes) { return bytes.starts_with("\x93NUMPY"); }, open_npy},
    Format{"NumPy archive", begins_as_npz, open_npz},
    Format{"FITS", [](std::string_view bytes) { return bytes.starts_with("SIMPLE  ="); }, open_fits},
    Format{"text", is_text, open_text_table},
};

const Format* format_of(std::string_view first_bytes) {
  const auto* found = std::ranges::find_if(formats, [&](const Format& f) { return f.begins_so(first_bytes); });
  return found == formats.end() ? nullptr : found;
}

std::string first_bytes(const std::filesystem::path& path) {
  check_plain_file(path, "particles");
  return some_bytes(path);
}

void append(Cloud& to, const Cloud& more) {
  for_each_column(to, more,
                  [](auto& column, const auto& rest) { column.insert(column.end(), rest.begin(), rest.end()); });
  to.origin = more.origin;
  if (std::abs(more.farthest) > std::abs(to.farthest)) to.farthest = more.farthest;
  to.box_size = more.box_size;
}

/// Opens by what the file holds, whatever its name.
CloudSource open_by_content(const std::filesystem::path& path, const CloudChoice& choice) {
  const Format* format = format_of(first_bytes(path));
  if (format != nullptr) return format->open(path, choice);
  std::vector<std::string_view> names;
  for (const Format& known : formats) names.push_back(known.name);
  throw Error(ErrorKind::bad_input,
              fmt::format("{}: is of no known format, expected one of: {}", path.string(), fmt::join(names, ", ")));
}

}  // namespace

bool holds_particles(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return false;
  const std::string bytes = some_bytes(path);
  const Format* format = format_of(bytes);
  return format != nullptr && (format->open != open_text_table || looks_like_table(bytes));
}

CloudSource open_cloud(const std::filesystem::path& path, const CloudChoice& choice) {
  if (!choice.type_colours.empty()) return open_types(path, choice);
  CloudChoice with_type = choice;
  if (choice.type.empty()) with_type.type = "gas";
  CloudSource source = open_by_content(path, with_type);
  if (!choice.type.empty() && !source.format.starts_with("GADGET"))
    throw Error(ErrorKind::wrong_usage,
                fmt::format("{}: is {}, but a particle type is chosen, expected a GADGET snapshot", path.string(),
                            source.format));
  // The header of other snapshots has a redshift, too, which means nothing.
  if (source.time && source.redshift && !is_scale_factor(*source.time, *source.redshift)) source.redshift.reset();
  return source;
}

Cloud read_cloud(const std::filesystem::path& path, const CloudChoice& choice, const Progress& progress) {
  return read_cloud(open_cloud(path, choice), path, progress);
}

Cloud read_cloud(const CloudSource& source, const std::filesystem::path& path, const Progress& progress) {
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
