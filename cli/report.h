#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace wheatstone::cli {

using Json = nlohmann::ordered_json;

/// One thing that a command tells of its result: a member of the JSON object, text of one line or several, or both.
struct Fact {
  std::string key;  ///< empty: only the text tells it
  Json value;
  std::string text = {};  ///< empty: only the JSON object tells it
};

/// What a command tells of its result. A report without facts is not printed.
struct Report {
  std::vector<Fact> facts;
  int exit_code = 0;                       ///< of what failed, where other work was done
  std::vector<std::string> failures = {};  ///< a line each, on standard error
};

/// Adds the members of an object, which have no text.
void add_members(Report& report, const Json& object);

/// The same without keys and values: text alone.
inline Fact only_text(std::string text) { return {{}, {}, std::move(text)}; }

Json json_of(const Report& report);

/// "label  text" for each text, one a line.
std::string lines(const std::string& label, const std::vector<std::string>& texts);

/// Facts as JSON text. File names are bytes, which need not be UTF-8: what is not becomes U+FFFD.
/// `indent` < 0 puts everything on one line.
std::string json_text(const Json& facts, int indent = 2);

/// A message on one line, whatever the names of files in it hold: control characters become spaces.
std::string one_line(std::string message);

}  // namespace wheatstone::cli
