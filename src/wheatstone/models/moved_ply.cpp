#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <sstream>
#include <string_view>
#include <utility>

#include "wheatstone/models/moved_vertices_internal.h"

namespace wheatstone {
namespace {

/// Where the coordinates of the vertices are in a PLY file.
struct PlyVertices {
  bool is_text = false, is_swapped = false;
  std::uint64_t count = 0;
  std::size_t begin = 0;                ///< of the first vertex, in the file
  std::size_t bytes = 0;                ///< of a vertex, where it is not text
  std::array<std::size_t, 3> places{};  ///< of the coordinates in a vertex: which word, or at which byte
};

std::size_t bytes_of_type(std::string_view type) {
  constexpr std::array<std::pair<std::string_view, std::size_t>, 16> types{{{"char", 1},
                                                                            {"int8", 1},
                                                                            {"uchar", 1},
                                                                            {"uint8", 1},
                                                                            {"short", 2},
                                                                            {"int16", 2},
                                                                            {"ushort", 2},
                                                                            {"uint16", 2},
                                                                            {"int", 4},
                                                                            {"int32", 4},
                                                                            {"uint", 4},
                                                                            {"uint32", 4},
                                                                            {"float", 4},
                                                                            {"float32", 4},
                                                                            {"double", 8},
                                                                            {"float64", 8}}};
  const auto* const found = std::ranges::find(types, type, &std::pair<std::string_view, std::size_t>::first);
  return found == types.end() ? 0 : found->second;
}

/// The next line of a header, of whatever ending; moves `at` behind it.
std::string_view next_line(std::string_view text, std::size_t& at) {
  const std::size_t end = std::min(text.find_first_of("\r\n", at), text.size());
  const std::string_view line = text.substr(at, end - at);
  at = std::min(end + (text.substr(end, 2) == "\r\n" ? 2 : 1), text.size());
  return line;
}

/// Reads the properties of vertices. False for a list or an unknown type, or binary coordinates in single precision.
class VertexProperties {
 public:
  bool add(const std::string& type, const std::string& name, PlyVertices& vertices) {
    const std::size_t bytes = bytes_of_type(type);
    if (bytes == 0) return false;
    const std::size_t axis = std::string_view("xyz").find(name);
    if (name.size() == 1 && axis != std::string_view::npos) {
      if (!vertices.is_text && bytes != sizeof(double)) return false;
      vertices.places[axis] = vertices.is_text ? words_ : vertices.bytes;
      found_ |= 1u << axis;
    }
    ++words_;
    vertices.bytes += bytes;
    return true;
  }
  bool has_all() const { return found_ == 0b111u; }

 private:
  std::size_t words_ = 0;
  unsigned found_ = 0;
};

std::optional<PlyVertices> find_vertices(std::string_view ply) {
  PlyVertices vertices;
  VertexProperties properties;
  std::string element;
  while (vertices.begin < ply.size()) {
    std::istringstream line{std::string(next_line(ply, vertices.begin))};
    std::string word, what, name;
    line >> word;
    if (word == "end_header") return properties.has_all() ? std::optional(vertices) : std::nullopt;
    if (word == "format") {
      line >> what;
      vertices.is_text = what == "ascii";
      vertices.is_swapped = what == "binary_big_endian";
    } else if (word == "element") {
      const bool is_first = element.empty();
      line >> element;
      if (is_first && (element != "vertex" || !(line >> vertices.count))) return {};
    } else if (word == "property" && element == "vertex") {
      line >> what >> name;
      if (!properties.add(what, name, vertices)) return {};
    }
  }
  return {};
}

double number_at(const std::string& bytes, std::size_t at, bool is_swapped) {
  std::array<char, sizeof(double)> of_number{};
  std::memcpy(of_number.data(), bytes.data() + at, sizeof(double));
  if (is_swapped) std::ranges::reverse(of_number);
  double number = 0;
  std::memcpy(&number, of_number.data(), sizeof(double));
  return number;
}

void put_number(double number, std::string& bytes, std::size_t at, bool is_swapped) {
  std::array<char, sizeof(double)> of_number{};
  std::memcpy(of_number.data(), &number, sizeof(double));
  if (is_swapped) std::ranges::reverse(of_number);
  std::memcpy(bytes.data() + at, of_number.data(), sizeof(double));
}

std::array<double, 3> move_binary(const PlyVertices& vertices, std::string& ply) {
  if (vertices.count > (ply.size() - vertices.begin) / vertices.bytes) return {};
  const auto place = [&](std::uint64_t v, std::size_t axis) {
    return vertices.begin + v * vertices.bytes + vertices.places[axis];
  };
  VertexBox box;
  for (std::uint64_t v = 0; v < vertices.count; ++v) {
    std::array<double, 3> position{};
    for (std::size_t axis = 0; axis < 3; ++axis) position[axis] = number_at(ply, place(v, axis), vertices.is_swapped);
    if (!std::ranges::all_of(position, [](double number) { return std::isfinite(number); })) return {};
    box.add(position);
  }
  const std::array<double, 3> middle = box.middle_if_far();
  if (middle == std::array<double, 3>{}) return {};
  for (std::uint64_t v = 0; v < vertices.count; ++v)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::size_t at = place(v, axis);
      put_number(number_at(ply, at, vertices.is_swapped) - middle[axis], ply, at, vertices.is_swapped);
    }
  return middle;
}

/// A coordinate in a text.
struct WrittenNumber {
  double number = 0;
  std::size_t begin = 0, end = 0;
};

/// The coordinates of the vertex that is written from a place on; moves `at` behind its line.
std::optional<std::array<WrittenNumber, 3>> written_vertex(const PlyVertices& vertices, std::string_view ply,
                                                           std::size_t& at) {
  const std::size_t begin = at;
  const std::string_view line = next_line(ply, at);
  std::array<WrittenNumber, 3> vertex;
  std::size_t place = 0, found = 0;
  for (std::size_t word = 0;; ++word) {
    place = std::min(line.find_first_not_of(" \t", place), line.size());
    if (place == line.size()) break;
    const std::size_t end = std::min(line.find_first_of(" \t", place), line.size());
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (word != vertices.places[axis]) continue;
      WrittenNumber& one = vertex[axis] = {0, begin + place, begin + end};
      const auto [last, error] = std::from_chars(line.data() + place, line.data() + end, one.number);
      if (error != std::errc() || last != line.data() + end || !std::isfinite(one.number)) return {};
      ++found;
    }
    place = end;
  }
  return found == 3 ? std::optional(vertex) : std::nullopt;
}

std::array<double, 3> move_text(const PlyVertices& vertices, std::string& ply) {
  VertexBox box;
  std::size_t at = vertices.begin;
  for (std::uint64_t v = 0; v < vertices.count; ++v) {
    const auto vertex = written_vertex(vertices, ply, at);
    if (!vertex) return {};
    box.add({(*vertex)[0].number, (*vertex)[1].number, (*vertex)[2].number});
  }
  const std::array<double, 3> middle = box.middle_if_far();
  if (middle == std::array<double, 3>{}) return {};
  std::string moved = ply.substr(0, vertices.begin);
  moved.reserve(ply.size());
  at = vertices.begin;
  std::size_t copied = at;
  for (std::uint64_t v = 0; v < vertices.count; ++v) {
    auto vertex = *written_vertex(vertices, ply, at);
    for (std::size_t axis = 0; axis < 3; ++axis) vertex[axis].number -= middle[axis];
    std::ranges::sort(vertex, {}, &WrittenNumber::begin);
    for (const WrittenNumber& one : vertex) {
      moved.append(ply, copied, one.begin - copied);
      fmt::format_to(std::back_inserter(moved), "{:.9g}", one.number);
      copied = one.end;
    }
  }
  moved.append(ply, copied);
  ply = std::move(moved);
  return middle;
}

}  // namespace

std::array<double, 3> move_ply_to_origin(std::string& ply) {
  const std::optional<PlyVertices> vertices = find_vertices(ply);
  if (!vertices) return {};
  return vertices->is_text ? move_text(*vertices, ply) : move_binary(*vertices, ply);
}

}  // namespace wheatstone
