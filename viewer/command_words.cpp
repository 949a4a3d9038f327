#include "command_words.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <utility>

#include "wheatstone/error.h"

namespace wheatstone::viewer {

Words words_of(std::string_view line) {
  Words words;
  std::string word;
  bool quoted = false, begun = false;
  for (const char letter : line) {
    if (letter == '"') {
      quoted = !quoted;
      begun = true;
    } else if (letter == '#' && words.empty() && !begun) {
      return {};
    } else if (!quoted && (letter == ' ' || letter == '\t' || letter == '\r')) {
      if (begun) words.push_back(std::exchange(word, {}));
      begun = false;
    } else {
      word += letter;
      begun = true;
    }
  }
  if (quoted) throw Error(ErrorKind::wrong_usage, fmt::format("'{}' has a quote that is not closed", line));
  if (begun) words.push_back(std::move(word));
  return words;
}

double number_of(const std::string& word) {
  double number = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
  if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(number))
    throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is no number", word));
  return number;
}

double number_of(const std::string& word, double least, double most) {
  const double number = number_of(word);
  if (number < least || number > most)
    throw Error(ErrorKind::wrong_usage, fmt::format("{} is out of range, expected {} to {}", word, least, most));
  return number;
}

bool switch_of(const std::string& word) {
  if (word == "on") return true;
  if (word == "off") return false;
  throw Error(ErrorKind::wrong_usage, fmt::format("'{}' is neither on nor off", word));
}

}  // namespace wheatstone::viewer
