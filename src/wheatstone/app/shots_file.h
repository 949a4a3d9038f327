#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "wheatstone/app/film_shots.h"

namespace wheatstone {

// A shots file (TOML) says where the shots of a film begin, and how each is painted: one [[shot]] a shot, in order,
// with a [[shot.key]] for each moment that numbers move to. docs/rotoscope.md describes it.

/// A shot as it was found.
struct FoundShot {
  std::int64_t begin = 0;   ///< frame, counted from 0
  std::int64_t frames = 0;  ///< how many it has
  double begin_s = 0;       ///< time of its first frame
  double length_s = 0;
  std::string thumbnail;  ///< name of the picture beside the file
  /// The film dissolves into the shot: how many frames before its first are mixtures, which belong to the shot before.
  std::int64_t mixed_before = 0;
};

/// Shots as a shots file that changes nothing: what may be set for a shot stands there as a comment.
std::string shots_file_text(std::span<const FoundShot> shots);

/// A frame, counted from 1 in the whole film, or the first one that is shown at a time in seconds or later.
using WrittenFrame = std::variant<std::int64_t, double>;

/// A moment of a shot and the numbers that it gives.
struct WrittenKey {
  struct Value {
    std::string_view parameter;
    float value = 0;
  };
  WrittenFrame at;
  std::vector<Value> values;
  FrameMaps maps = {};  ///< from there on; empty: as before
  std::string where;    ///< for messages: "shots.toml: shot 2, key 1, line 14"
};

/// A shot as a shots file has it.
struct WrittenShot {
  WrittenFrame begin;
  std::optional<std::int64_t> last;      ///< last frame, to be checked
  std::optional<WrittenFrame> dissolve;  ///< how many frames, or seconds, the shot before fades out over
  FilmShot painted;                      ///< its `begin` and what moves are not known yet
  FrameMaps maps = {};                   ///< from the first frame on
  std::vector<WrittenKey> keys = {};
  std::string where;  ///< for messages: "shots.toml: shot 2, line 14"
};

/// A key of the file that has no effect in this run, and why, as "on marks (.wst)".
struct UnusedKey {
  std::string key, why;
  bool if_moved = false;  ///< it has an effect on a whole shot
};

/// Reads a shots file. What a shot does not set is as `all` has it; a shot with a style of its own takes the seed alone
/// from the style of all. Style files and maps are named as seen from the folder of `file`, which also stands in
/// messages. Throws Error{bad_input} that names file, shot and line or key: not TOML, unknown keys, values that do not
/// fit, keys that have no effect on the shot's marks or in this run, parameters that cannot move, or are set by a shot
/// and by its keys.
std::vector<WrittenShot> parse_shots(std::string_view toml, const std::filesystem::path& file,
                                     const RotoscopeOptions& all, std::span<const UnusedKey> unused = {});

/// The same of a file of at most 1 MiB.
std::vector<WrittenShot> read_shots(const std::filesystem::path& file, const RotoscopeOptions& all,
                                    std::span<const UnusedKey> unused = {});

}  // namespace wheatstone
