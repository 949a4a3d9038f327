#include "typed_options.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace wheatstone::cli {

std::string option_name(const std::string& names) {
  const std::size_t dashes = names.find("--");
  if (dashes == std::string::npos) return names;
  return names.substr(dashes, names.find(',', dashes) - dashes);
}

CLI::Option* add_name(CLI::App& command, const std::string& names, std::string& value,
                      std::span<const std::string_view> choices, const std::string& help) {
  const std::string all = fmt::format("{}", fmt::join(choices, "|"));
  CLI::Option* option =
      typed::add(command, names, value, help, [name = option_name(names), choices, all](const std::string& text) {
        if (std::ranges::find(choices, text) == choices.end())
          throw Error(ErrorKind::wrong_usage, fmt::format("{}: is '{}', expected {}", name, text, all));
        return text;
      });
  if (!value.empty()) option->default_str(value);
  return option->type_name(all);
}

}  // namespace wheatstone::cli
