#include "wheatstone/app/shots_file.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cstddef>
#include <sstream>
#include <utility>

#include "wheatstone/app/detail_map.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"
#include "wheatstone/painting/paint.h"
#include "wheatstone/painting/style_parameters.h"
#include "wheatstone/pictures/disparity_file.h"
#include "wheatstone/video/film_time.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view detail_key = "detail-map", disparity_key = "disparity";
constexpr std::array<std::string_view, 9> keys_of_shots{
    "begin", "last", "dissolve", "style", "depth-budget", "zero-parallax", "key", detail_key, disparity_key};

/// The rows of an array of tables, each with its name, as "shots.toml: shot 2".
template <class Read>
void for_each_table(const toml::array& tables, const std::string& name, std::string_view header, Read read) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const std::string one = fmt::format("{} {}", name, i + 1);
    const toml::table* const table = tables[i].as_table();
    if (table == nullptr) throw Error(ErrorKind::bad_input, fmt::format("{}: is no table, expected {}", one, header));
    read(*table, one);
  }
}

/// A [[shot]] that is being read, or one of its keys.
class ShotTable {
 public:
  ShotTable(const toml::table& table, std::string shot, const fs::path& folder)
      : table_(table), shot_(std::move(shot)), folder_(folder) {}

  WrittenShot read(const RotoscopeOptions& all, std::span<const UnusedKey> unused) const {
    check_keys(unused);
    const RotoscopeOptions own = painted(all);
    WrittenShot shot{
        .begin = written_frame("begin", "its first frame"),
        .painted = {.style = own.style, .depth_budget = own.depth_budget, .zero_parallax_px = own.zero_parallax_px},
        .where = at(table_)};
    shot.maps = maps(own.style);
    if (const toml::node* last = table_.get("last")) shot.last = frame("last", *last);
    if (const toml::node* dissolve = table_.get("dissolve"))
      shot.dissolve = frame_or_time("dissolve", *dissolve, "a number of frames, or a time, as \"0.5\"");
    const toml::node* const keys = table_.get("key");
    if (keys == nullptr) return shot;
    if (!keys->is_array()) refuse("key", *keys, "[[shot.key]] tables");
    for_each_table(*keys->as_array(), shot_ + ", key", "[[shot.key]]",
                   [&](const toml::table& table, const std::string& name) {
                     shot.keys.push_back(ShotTable(table, name, folder_).read_key(own, table_, unused));
                   });
    return shot;
  }

 private:
  /// What a key of a shot gives, which `of_shot` and its table have otherwise.
  WrittenKey read_key(const RotoscopeOptions& of_shot, const toml::table& shot,
                      std::span<const UnusedKey> unused) const {
    WrittenKey key{.at = written_frame("at", "a frame of the shot"), .values = {}, .where = at(table_)};
    check_use(unused, true);
    key.maps = maps(of_shot.style);
    for (const auto& [name, node] : table_) {
      if (name.str() == "at" || name.str() == detail_key || name.str() == disparity_key) continue;
      const MovableParameter* const parameter = movable(name.str(), node);
      if (shot.contains(name.str()))
        throw Error(
            ErrorKind::bad_input,
            fmt::format("{}: '{}' is also set by the shot; leave it out there, or in its keys", at(node), name.str()));
      key.values.push_back({parameter->name, 0});
    }
    if (key.values.empty() && key.maps.empty())
      throw Error(ErrorKind::bad_input, fmt::format("{}: gives no number, expected {}, {} or one of {}", at(table_),
                                                    detail_key, disparity_key, movables()));
    const RotoscopeOptions then = painted(of_shot);
    for (WrittenKey::Value& value : key.values) value.value = find_movable_parameter(value.parameter)->get(then);
    if (const toml::node* budget = table_.get("depth-budget"); budget != nullptr && !then.depth_budget)
      refuse("depth-budget", *budget, "a share of the width, which moves; the whole depth is \"100%\"");
    return key;
  }

  /// A file that the table names, which `check` throws for if it cannot be used; empty where the table has none.
  template <class Check>
  fs::path map_file(std::string_view key, Check check) const {
    const toml::node* const node = table_.get(key);
    if (node == nullptr) return {};
    const auto* name = node->as_string();
    if (name == nullptr) refuse(key, *node, "the name of a file");
    fs::path file = folder_ / name->get();
    try {
      check(file);
    } catch (const Error& error) {
      throw Error(ErrorKind::bad_input, fmt::format("{}: {}", at(*node), error.what()));
    }
    return file;
  }

  FrameMaps maps(const Style& style) const {
    const auto check_detail = [&style](const fs::path& file) {
      check_reads_detail(style);
      read_detail_map(file);
    };
    return {map_file(detail_key, check_detail),
            map_file(disparity_key, [](const fs::path& file) { read_disparity(file); })};
  }

  /// `all` with what the table sets.
  RotoscopeOptions painted(RotoscopeOptions all) const {
    all.style = style(all.style);
    if (const toml::node* budget = table_.get("depth-budget")) all.depth_budget = depth_budget(*budget);
    if (const toml::node* zero = table_.get("zero-parallax")) all.zero_parallax_px = zero_parallax(*zero);
    return all;
  }

  static std::string movables() {
    std::vector<std::string_view> names;
    for (const MovableParameter& parameter : movable_parameters()) names.push_back(parameter.name);
    return fmt::format("{}", fmt::join(names, ", "));
  }

  const MovableParameter* movable(std::string_view name, const toml::node& node) const {
    const bool is_known =
        find_parameter(name) != nullptr || std::ranges::find(keys_of_shots, name) != keys_of_shots.end();
    const MovableParameter* const parameter = find_movable_parameter(name);
    if (parameter == nullptr)
      throw Error(ErrorKind::bad_input, fmt::format("{}: {}, expected at and one of {}", at(node),
                                                    is_known ? fmt::format("'{}' does not move", name)
                                                             : fmt::format("unknown key '{}'", name),
                                                    movables()));
    return parameter;
  }

  std::string at(const toml::node& node) const { return fmt::format("{}, line {}", shot_, node.source().begin.line); }

  [[noreturn]] void refuse(std::string_view key, const toml::node& node, std::string_view expected) const {
    throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' is not {}", at(node), key, expected));
  }

  /// Throws for a key of the table that has no effect; in a [[shot.key]], what it gives moves.
  void check_use(std::span<const UnusedKey> unused, bool is_moved) const {
    for (const auto& [name, node] : table_) {
      const std::string_view key = name.str();
      const auto no_use = std::ranges::find_if(
          unused, [&](const UnusedKey& one) { return one.key == key && (is_moved || !one.if_moved); });
      if (no_use != unused.end())
        throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' has no effect {}", at(node), key, no_use->why));
    }
  }

  void check_keys(std::span<const UnusedKey> unused) const {
    check_use(unused, false);
    for (const auto& [name, node] : table_) {
      const std::string_view key = name.str();
      if (std::ranges::find(keys_of_shots, key) != keys_of_shots.end() || find_parameter(key) != nullptr) continue;
      std::vector<std::string_view> known(keys_of_shots.begin(), keys_of_shots.end());
      for (const StyleParameter& parameter : style_parameters()) known.push_back(parameter.name);
      throw Error(ErrorKind::bad_input,
                  fmt::format("{}: unknown key '{}', expected one of {}", at(node), key, fmt::join(known, ", ")));
    }
  }

  static const StyleParameter* find_parameter(std::string_view key) {
    const auto found = std::ranges::find(style_parameters(), key, &StyleParameter::name);
    return found == style_parameters().end() ? nullptr : &*found;
  }

  std::int64_t frame(std::string_view key, const toml::node& node,
                     std::string_view expected = "a frame, counted from 1") const {
    constexpr std::int64_t most_frames = 1'000'000'000;
    const auto* number = node.as_integer();
    if (number == nullptr || number->get() < 1 || number->get() > most_frames) refuse(key, node, expected);
    return number->get();
  }

  WrittenFrame written_frame(std::string_view key, std::string_view what) const {
    const toml::node* node = table_.get(key);
    if (node == nullptr)
      throw Error(ErrorKind::bad_input, fmt::format("{}: has no '{}', expected {}, or a time", at(table_), key, what));
    return frame_or_time(key, *node, "a frame, counted from 1, or a time, as \"0:02.5\"");
  }

  WrittenFrame frame_or_time(std::string_view key, const toml::node& node, std::string_view expected) const {
    if (node.is_integer()) return frame(key, node, expected);
    const auto* text = node.as_string();
    const std::optional<double> seconds = text != nullptr ? film_time_from(text->get()) : std::nullopt;
    if (!seconds) refuse(key, node, expected);
    return *seconds;
  }

  std::optional<float> depth_budget(const toml::node& node) const {
    if (const auto* text = node.as_string(); text != nullptr && text->get() == "full") return std::nullopt;
    double share = 0;
    if (const auto* text = node.as_string()) {
      const std::string& words = text->get();
      const char* const end = words.data() + words.size();
      const auto read = std::from_chars(words.data(), end, share);
      const bool is_percent = read.ec == std::errc() && std::string_view(read.ptr, end) == "%";
      share = is_percent ? share / 100 : 0;
    } else {
      share = node.value<double>().value_or(0);
    }
    if (!(share >= 0.001 && share <= 1))
      refuse("depth-budget", node, R"(a share of the width from 0.1 to 100 %, as "3%" or 0.03, or "full")");
    return static_cast<float>(share);
  }

  float zero_parallax(const toml::node& node) const {
    const double pixels = node.is_number() ? node.value<double>().value_or(no_bound) : no_bound;
    if (!zero_parallax_range.has(pixels))
      refuse("zero-parallax", node, "a disparity in pixels" + words_of(zero_parallax_range));
    return static_cast<float>(pixels);
  }

  Style style(const Style& of_all) const {
    Style style = of_all;
    if (const toml::node* name = table_.get("style")) style = named_style(*name, of_all.seed);
    // The values as they would stand in a style file, which knows how to read them.
    std::ostringstream file;
    for (const auto& [key, node] : table_) {
      if (find_parameter(key.str()) == nullptr) continue;
      file << key.str() << " = ";
      node.visit([&file](const auto& value) { file << value; });
      file << "\n";
    }
    apply_toml(file.str(), shot_, style);
    for (const auto& [key, node] : table_) check_effect(key.str(), node, style);
    return style;
  }

  Style named_style(const toml::node& node, std::uint64_t seed) const {
    const auto* name = node.as_string();
    if (name == nullptr) refuse("style", node, "the name of a style or of a style file");
    try {
      const fs::path path = name->get();
      const bool is_file = path.extension() == ".toml" || path.has_parent_path();
      Style style = read_style(is_file ? (folder_ / path).string() : name->get());
      style.seed = seed;
      return style;
    } catch (const Error& error) {
      throw Error(ErrorKind::bad_input, fmt::format("{}: {}", at(node), error.what()));
    }
  }

  void check_effect(std::string_view key, const toml::node& node, const Style& style) const {
    const StyleParameter* parameter = find_parameter(key);
    if (key == "propagation" && is_of_strokes(style))
      throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' has no effect on the strokes of a film", at(node), key));
    if (parameter == nullptr || is_read_by(*parameter, style.marks)) return;
    std::vector<std::string_view> works_with;
    for (const Marks marks : parameter->read_by) works_with.push_back(name_of(marks));
    throw Error(ErrorKind::bad_input, fmt::format("{}: '{}' has no effect on a painting of {}; it works with {}",
                                                  at(node), key, name_of(style.marks), fmt::join(works_with, ", ")));
  }

  const toml::table& table_;
  std::string shot_;  ///< "shots.toml: shot 2"
  const fs::path& folder_;
};

}  // namespace

std::string shots_file_text(std::span<const FoundShot> shots) {
  std::string text =
      "# The shots of a film, for `wheatstone rotoscope --shots`. A shot lasts until the next one begins: add a\n"
      "# [[shot]] to add a cut, and delete one to remove its cut. `begin` is the first frame, counted from 1, or a\n"
      "# time, as \"0:02.5\". What a shot does not set is as on the command line. A shot takes `style`, all "
      "parameters\n"
      "# of its style, `depth-budget`, `zero-parallax`, and `last`, its last frame, if that is to be checked. The\n"
      "# shot before it fades out in its first `dissolve` frames. A [[shot.key]] after it gives numbers `at` a frame\n"
      "# or time, between which they move.\n";
  for (std::size_t i = 0; i < shots.size(); ++i) {
    const FoundShot& shot = shots[i];
    text += fmt::format(
        "\n[[shot]]  # {}: from {} on, {} frame{}, {:.3f} s, {}{}\n"
        "begin = {}\n"
        "# style = \"oil\"\n"
        "# radii = [8, 4, 2]\n"
        "# depth-budget = \"3%\"\n"
        "# zero-parallax = 0\n",
        i + 1, film_time_text(shot.begin_s), shot.frames, shot.frames == 1 ? "" : "s", shot.length_s, shot.thumbnail,
        shot.mixed_before > 0 ? fmt::format(", after a dissolve of {} frames", shot.mixed_before) : "", shot.begin + 1);
  }
  return text;
}

std::vector<WrittenShot> parse_shots(std::string_view toml, const fs::path& file, const RotoscopeOptions& all,
                                     std::span<const UnusedKey> unused) {
  const std::string name = file.string();
  const auto refuse = [&name](const std::string& what) {
    throw Error(ErrorKind::bad_input, fmt::format("{}: {}", name, what));
  };
  std::vector<WrittenShot> shots;
  try {
    const toml::table document = toml::parse(toml);
    for (const auto& [key, node] : document)
      if (key.str() != "shot")
        refuse(fmt::format("line {}: unknown key '{}', expected [[shot]] tables", node.source().begin.line, key.str()));
    const toml::array* tables = document["shot"].as_array();
    if (tables == nullptr || tables->empty()) refuse("has no shots, expected [[shot]] tables");
    for_each_table(*tables, name + ": shot", "[[shot]]", [&](const toml::table& table, const std::string& shot) {
      shots.push_back(ShotTable(table, shot, file.parent_path()).read(all, unused));
    });
  } catch (const toml::parse_error& error) {
    refuse(fmt::format("line {}: {}", error.source().begin.line, error.description()));
  }
  return shots;
}

std::vector<WrittenShot> read_shots(const fs::path& file, const RotoscopeOptions& all,
                                    std::span<const UnusedKey> unused) {
  constexpr std::size_t most_bytes = 1 << 20;
  return parse_shots(read_whole_file(file, most_bytes), file, all, unused);
}

}  // namespace wheatstone
