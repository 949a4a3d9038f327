#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "wheatstone/models/moved_vertices_internal.h"

namespace wheatstone {
namespace {

struct VertexLine {
  std::array<double, 3> position;
  std::size_t end;  ///< of the three numbers, in the text
};

/// The vertex in the line that begins at a place of the text, if it is one.
std::optional<VertexLine> vertex_at(std::string_view text, std::size_t at) {
  const auto is_blank = [&] { return at < text.size() && (text[at] == ' ' || text[at] == '\t'); };
  while (is_blank()) ++at;
  if (at + 1 >= text.size() || text[at] != 'v' || (text[at + 1] != ' ' && text[at + 1] != '\t')) return {};
  ++at;
  VertexLine vertex{};
  for (double& coordinate : vertex.position) {
    while (is_blank()) ++at;
    const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), coordinate);
    if (error != std::errc() || !std::isfinite(coordinate)) return {};
    at = static_cast<std::size_t>(end - text.data());
  }
  vertex.end = at;
  return vertex;
}

template <class Visit>
void for_each_line(std::string_view text, Visit&& visit) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    visit(at, end);
    at = end;
  }
}

}  // namespace

std::array<double, 3> move_obj_to_origin(std::string& obj) {
  VertexBox box;
  for_each_line(obj, [&](std::size_t begin, std::size_t /*end*/) {
    if (const std::optional<VertexLine> vertex = vertex_at(obj, begin)) box.add(vertex->position);
  });
  const std::array<double, 3> middle = box.middle_if_far();
  if (middle == std::array<double, 3>{}) return {};
  std::string moved;
  moved.reserve(obj.size());
  for_each_line(obj, [&](std::size_t begin, std::size_t end) {
    const std::optional<VertexLine> vertex = vertex_at(obj, begin);
    if (!vertex) {
      moved.append(obj, begin, end - begin);
      return;
    }
    const auto& [x, y, z] = vertex->position;
    fmt::format_to(std::back_inserter(moved), "v {:.9g} {:.9g} {:.9g}", x - middle[0], y - middle[1], z - middle[2]);
    moved.append(obj, vertex->end, end - vertex->end);
  });
  obj = std::move(moved);
  return middle;
}

}  // namespace wheatstone
