#include "placeholders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "wheatstone/error.h"

namespace wheatstone::cli {

std::string filled(const std::string& option, std::string_view words, std::span<const Placeholder> placeholders) {
  std::string text;
  while (!words.empty()) {
    const std::size_t begin = std::min(words.find('{'), words.size());
    text += words.substr(0, begin);
    words.remove_prefix(begin);
    const std::size_t end = words.find('}');
    if (words.empty() || end == std::string_view::npos) break;
    const std::string_view name = words.substr(1, end - 1);
    const auto found = std::ranges::find(placeholders, name, &Placeholder::name);
    const bool is_name =
        !name.empty() && std::ranges::all_of(name, [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; });
    if (found != placeholders.end()) {
      text += found->text;
      words.remove_prefix(end + 1);
    } else if (is_name) {
      std::string names;
      for (const Placeholder& known : placeholders)
        names += fmt::format("{}{{{}}}", names.empty() ? "" : ", ", known.name);
      throw Error(ErrorKind::wrong_usage,
                  fmt::format("{}: has {{{}}}, which stands for nothing, expected {}", option, name, names));
    } else {
      text += words.front();
      words.remove_prefix(1);
    }
  }
  return text.append(words);
}

}  // namespace wheatstone::cli
