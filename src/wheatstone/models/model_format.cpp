#include "wheatstone/models/model_format_internal.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <sstream>
#include <string>
#include <system_error>

#include "wheatstone/error.h"
#include "wheatstone/models/read_model.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {
namespace {

/// The beginning of a file and its length.
struct Beginning {
  std::string bytes;
  std::uint64_t length;
};

/// The words of the first line that is neither empty nor a comment; at the end of what was read, the last one.
std::string_view first_line(std::string_view text) {
  std::string_view line;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    const std::size_t first = line.find_first_not_of(" \t\r");
    if (first == std::string_view::npos || line[first] == '#') continue;
    return line.substr(first);
  }
  return {};
}

bool begins_as_obj(const Beginning& file) {
  const std::string_view line = first_line(file.bytes);
  const std::string_view word = line.substr(0, std::min(line.find_first_of(" \t"), line.size()));
  constexpr std::array<std::string_view, 10> words{"v", "vt", "vn", "f", "o", "g", "s", "usemtl", "mtllib", "vp"};
  if (word.size() == line.size() || std::ranges::find(words, word) == words.end()) return false;
  return word == "mtllib" || file.bytes.starts_with("v ") || file.bytes.find("\nv ") != std::string::npos;
}

/// Up to its last line, which the importer would look for without end; empty where there is none.
std::string_view ply_header(std::string_view text) {
  constexpr std::string_view last = "end_header", before = "\r\n", behind = " \t\r\n";
  for (std::size_t at = text.find(last); at != std::string_view::npos; at = text.find(last, at + 1)) {
    const std::size_t end = at + last.size();
    if (at > 0 && before.find(text[at - 1]) != std::string_view::npos && end < text.size() &&
        behind.find(text[end]) != std::string_view::npos)
      return text.substr(0, at);
  }
  return {};
}

/// A header that names faces, of which there are some.
bool begins_as_ply_with_faces(const Beginning& file) {
  const std::string_view text = ply_header(file.bytes);
  if (!text.starts_with("ply\n") && !text.starts_with("ply\r")) return false;
  const std::size_t faces = text.find("element face ");
  if (faces == std::string_view::npos) return false;
  const std::size_t count = text.find_first_not_of(" 0", faces + std::strlen("element face "));
  return count != std::string_view::npos && std::isdigit(static_cast<unsigned char>(text[count])) != 0;
}

bool begins_as_stl(const Beginning& file) {
  constexpr std::size_t header = 84, triangle = 50;
  if (file.bytes.size() >= header) {
    std::uint32_t count = 0;
    std::memcpy(&count, file.bytes.data() + 80, sizeof(count));
    if (file.length == header + triangle * std::uint64_t{count}) return true;
  }
  const std::string_view text = file.bytes;
  return text.starts_with("solid") && text.find("facet") != std::string_view::npos;
}

bool begins_as_glb(const Beginning& file) { return file.bytes.starts_with("glTF"); }

bool begins_as_gltf(const Beginning& file) {
  const std::string_view text = file.bytes;
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '{' && text.find("\"asset\"") != std::string_view::npos;
}

struct KnownFormat {
  ModelFormat format;
  bool (*begins_so)(const Beginning& file);
  bool has_own_ending;  ///< nothing else has it
};

constexpr std::array formats{
    KnownFormat{{"glTF", "glb", true, true}, begins_as_glb, true},
    KnownFormat{{"glTF", "gltf", true, true}, begins_as_gltf, true},
    KnownFormat{{"PLY", "ply"}, begins_as_ply_with_faces, false},
    KnownFormat{{"STL", "stl"}, begins_as_stl, true},
    KnownFormat{{"OBJ", "obj", true}, begins_as_obj, true},
};

const KnownFormat* format_of_name(const std::filesystem::path& path) {
  const std::string ending = ending_of(path);
  const auto* const found = std::ranges::find_if(formats, [&](const KnownFormat& f) {
    return f.has_own_ending && ending.substr(0, 1) == "." && ending.substr(1) == f.format.ending;
  });
  return found == formats.end() ? nullptr : found;
}

Beginning beginning_of(const std::filesystem::path& path) {
  std::error_code error;
  std::ifstream file(path, std::ios::binary);
  constexpr std::size_t most = 1 << 16;  // comments may come first
  Beginning beginning{std::string(most, '\0'), std::filesystem::file_size(path, error)};
  file.read(beginning.bytes.data(), most);
  beginning.bytes.resize(static_cast<std::size_t>(file.gcount()));
  return beginning;
}

const KnownFormat* format_of_content(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return nullptr;
  const Beginning beginning = beginning_of(path);
  const auto* const found = std::ranges::find_if(formats, [&](const KnownFormat& f) { return f.begins_so(beginning); });
  return found == formats.end() ? nullptr : found;
}

}  // namespace

bool holds_model(const std::filesystem::path& path) { return format_of_content(path) != nullptr; }

bool is_named_as_model(const std::filesystem::path& path) { return format_of_name(path) != nullptr; }

void check_ply_counts(const std::filesystem::path& path) {
  const Beginning file = beginning_of(path);
  std::string header(ply_header(file.bytes));
  std::ranges::replace(header, '\r', '\n');
  std::istringstream lines(header);
  std::uint64_t all = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word, name;
    std::uint64_t count = 0;
    words >> word >> name >> count;  // the largest where it is too large
    if (word != "element") continue;
    all += std::min(count, file.length + 1);
    if (all > file.length)
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: its header tells of {} elements '{}', more than {} bytes hold, expected a file that "
                              "is not damaged",
                              path.string(), count, name, file.length));
  }
}

const ModelFormat* format_of_model(const std::filesystem::path& path) {
  const KnownFormat* format = format_of_content(path);
  if (format == nullptr) format = format_of_name(path);
  return format != nullptr ? &format->format : nullptr;
}

}  // namespace wheatstone
