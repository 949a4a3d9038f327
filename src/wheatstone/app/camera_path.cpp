#include "wheatstone/app/camera_path.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <cmath>

#include "wheatstone/app/render_limits.h"
#include "wheatstone/depth/monotone_cubic.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace wheatstone {
namespace {

/// A number of a keyframe.
struct Channel {
  const char* name;
  std::optional<double> CameraKey::*value;
  NumberRange range;
  bool by_factors = false;
};
constexpr double any_number = 1e300;
constexpr std::array channels{Channel{"azimuth", &CameraKey::azimuth_deg, {-36000, 36000}},
                              Channel{"elevation", &CameraKey::elevation_deg, elevation_range},
                              Channel{"fov", &CameraKey::field_of_view_deg, field_of_view_range},
                              Channel{"zoom", &CameraKey::zoom, zoom_range, true},
                              Channel{"time", &CameraKey::time, {-any_number, any_number}}};

/// A curve that begins and ends at rest; nothing where no key has the value.
template <class Value>
std::optional<double> eased(const CameraPath& path, double at, Value value) {
  std::vector<CurvePoint> points;
  for (const CameraKey& key : path.keys)
    if (const std::optional<double> number = value(key)) points.push_back({key.at, *number});
  if (points.empty()) return std::nullopt;
  choose_slopes(points);
  points.front().slope = points.back().slope = 0;
  return value_at(points, at);
}

[[noreturn]] void refuse_key(const std::string& name, const std::string& what) {
  throw Error(ErrorKind::bad_input, fmt::format("{}: {}", name, what));
}

double number_of(const toml::node& node, const std::string& name, std::string_view key, NumberRange range) {
  const std::optional<double> number = node.value<double>();
  if (!number || !range.has(*number))
    refuse_key(name, range.most < any_number ? fmt::format("'{}' is not a number{}", key, words_of(range))
                                             : fmt::format("'{}' is not a finite number", key));
  return *number;
}

std::array<double, 3> point_of(const toml::node& node, const std::string& name) {
  const toml::array* list = node.as_array();
  if (list == nullptr || list->size() != 3) refuse_key(name, "'centre' is not a point [X, Y, Z]");
  std::array<double, 3> point{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    point[axis] = number_of(*list->get(axis), name, "centre", position_range);
  return point;
}

CameraKey key_of(const toml::table& table, const std::string& name) {
  CameraKey key;
  const toml::node* at = table.get("at");
  if (at == nullptr) refuse_key(name, "a [[key]] has no 'at', expected 0 for the first frame to 1 for the last");
  key.at = number_of(*at, name, "at", {0, 1});
  for (const auto& [toml_key, node] : table) {
    const std::string_view text = toml_key.str();
    if (text == "at") continue;
    if (text == "centre") {
      key.centre = point_of(node, name);
      continue;
    }
    const auto* const channel = std::ranges::find_if(channels, [&](const Channel& c) { return text == c.name; });
    if (channel == channels.end()) {
      std::vector<std::string_view> names{"at", "centre"};
      for (const Channel& known : channels) names.emplace_back(known.name);
      refuse_key(name, fmt::format("unknown key '{}', expected one of {}", text, fmt::join(names, ", ")));
    }
    key.*(channel->value) = number_of(node, name, text, channel->range);
  }
  return key;
}

}  // namespace

CameraKey camera_at(const CameraPath& path, double at) {
  CameraKey key{.at = at};
  for (const Channel& channel : channels) {
    key.*(channel.value) = eased(path, at, [&](const CameraKey& from) -> std::optional<double> {
      const std::optional<double>& value = from.*(channel.value);
      if (!value) return std::nullopt;
      return channel.by_factors ? std::log(*value) : *value;
    });
    std::optional<double>& value = key.*(channel.value);
    if (value && channel.by_factors) value = std::exp(*value);
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> coordinate = eased(path, at, [&](const CameraKey& from) -> std::optional<double> {
      if (!from.centre) return std::nullopt;
      return (*from.centre)[axis];
    });
    if (!coordinate) break;
    if (!key.centre) key.centre.emplace();
    (*key.centre)[axis] = *coordinate;
  }
  return key;
}

void turn_as(const CameraKey& key, Framing& framing) {
  const auto take = [](const std::optional<double>& from, float& to) {
    if (from) to = static_cast<float>(*from);
  };
  take(key.azimuth_deg, framing.azimuth_deg);
  take(key.elevation_deg, framing.elevation_deg);
  take(key.field_of_view_deg, framing.field_of_view_deg);
  take(key.zoom, framing.zoom);
}

CameraPath parse_camera_path(std::string_view toml, const std::string& name) {
  CameraPath path;
  try {
    const toml::table table = toml::parse(toml);
    for (const auto& [key, node] : table)
      if (key.str() != "key") refuse_key(name, fmt::format("unknown table '{}', expected [[key]]", key.str()));
    const toml::array* keys = table["key"].as_array();
    if (keys == nullptr || keys->empty()) refuse_key(name, "has no keyframes, expected [[key]] tables");
    for (const toml::node& node : *keys) {
      if (!node.is_table()) refuse_key(name, "has a 'key' that is no table, expected [[key]]");
      path.keys.push_back(key_of(*node.as_table(), name));
    }
  } catch (const toml::parse_error& error) {
    refuse_key(name, fmt::format("line {}: {}", error.source().begin.line, error.description()));
  }
  for (std::size_t i = 1; i < path.keys.size(); ++i)
    if (!(path.keys[i].at > path.keys[i - 1].at))
      refuse_key(name, fmt::format("a keyframe at {} follows one at {}, expected ascending moments", path.keys[i].at,
                                   path.keys[i - 1].at));
  return path;
}

std::string camera_path_text(const CameraPath& path) {
  std::string text;
  for (const CameraKey& key : path.keys) {
    text += fmt::format("{}[[key]]\nat = {}\n", text.empty() ? "" : "\n", key.at);
    for (const Channel& channel : channels)
      if (const std::optional<double>& value = key.*(channel.value))
        text += fmt::format("{} = {}\n", channel.name, *value);
    if (key.centre) text += fmt::format("centre = {}\n", *key.centre);
  }
  return text;
}

CameraPath read_camera_path(const std::filesystem::path& file) {
  constexpr std::size_t most_bytes = 1 << 20;
  return parse_camera_path(read_whole_file(file, most_bytes), file.string());
}

}  // namespace wheatstone
