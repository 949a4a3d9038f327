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

// A shots file (TOML) says where the shots of a film begin, and how each is painted: one [[shot]] a shot, in order.
// docs/rotoscope.md describes it.

/// A shot as it was found.
struct FoundShot {
  std::int64_t begin = 0;   ///< frame, counted from 0
  std::int64_t frames = 0;  ///< how many it has
  double begin_s = 0;       ///< time of its first frame
  double length_s = 0;
  std::string thumbnail;  ///< name of the picture beside the file
};

/// Shots as a shots file that changes nothing: what may be set for a shot stands there as a comment.
std::string shots_file_text(std::span<const FoundShot> shots);

/// A shot as a shots file has it.
struct WrittenShot {
  std::variant<std::int64_t, double> begin;  ///< first frame, counted from 1 in the whole film, or its time in seconds
  std::optional<std::int64_t> last;          ///< last frame, to be checked
  FilmShot painted;                          ///< its `begin` is not known yet
  std::string where;                         ///< for messages: "shots.toml: shot 2, line 14"
};

/// A key that has no effect in this run, and why, as "on marks (.wst)".
struct UnusedKey {
  std::string key, why;
};

/// Reads a shots file. What a shot does not set is as `all` has it; a shot with a style of its own takes the seed alone
/// from the style of all. Style files are named as seen from the folder of `file`, which also stands in messages.
/// Throws Error{bad_input} that names file, shot and line or key: not TOML, unknown keys, values that do not fit, keys
/// that have no effect on the shot's marks or in this run.
std::vector<WrittenShot> parse_shots(std::string_view toml, const std::filesystem::path& file,
                                     const RotoscopeOptions& all, std::span<const UnusedKey> unused = {});

/// The same of a file of at most 1 MiB.
std::vector<WrittenShot> read_shots(const std::filesystem::path& file, const RotoscopeOptions& all,
                                    std::span<const UnusedKey> unused = {});

}  // namespace wheatstone
