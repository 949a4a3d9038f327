#include "completion.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <vector>

#include "manual_page.h"

namespace wheatstone::packaging {
namespace {

/// An option as a shell sees it.
struct OfferedOption {
  std::vector<std::string> names;   ///< "-o", "--output"
  std::vector<std::string> values;  ///< that it takes, where there is a list of them
  bool takes_value = false;
  std::string description;
};

/// A command, and what may stand behind it.
struct OfferedCommand {
  std::vector<std::string> words;                          ///< behind the program's name
  std::vector<std::pair<std::string, std::string>> below;  ///< commands and their descriptions
  std::vector<OfferedOption> options;
};

/// "auto|always|never" of the type's name.
std::vector<std::string> values_of(const std::string& type) {
  std::vector<std::string> values;
  if (type.find('|') == std::string::npos) return values;
  for (std::size_t begin = 0; begin <= type.size();) {
    const std::size_t end = std::min(type.find('|', begin), type.size());
    values.push_back(type.substr(begin, end - begin));
    begin = end + 1;
  }
  return values;
}

void add_options(const CLI::App& app, std::vector<OfferedOption>& options) {
  for (const CLI::Option* option : app.get_options([](const CLI::Option* o) { return o->nonpositional(); })) {
    OfferedOption offered;
    for (const std::string& name : option->get_snames()) offered.names.push_back("-" + name);
    for (const std::string& name : option->get_lnames()) offered.names.push_back("--" + name);
    offered.takes_value = option->get_items_expected_max() > 0;
    if (offered.takes_value) offered.values = values_of(option->get_type_name());
    offered.description = option->get_description();
    options.push_back(std::move(offered));
  }
}

/// The program and every command below it.
std::vector<OfferedCommand> offered(const CLI::App& program) {
  std::vector<OfferedCommand> all;
  const std::function<void(const CLI::App&, std::vector<std::string>)> visit = [&](const CLI::App& app,
                                                                                   std::vector<std::string> words) {
    OfferedCommand command{.words = words, .below = {}, .options = {}};
    add_options(app, command.options);
    if (&app != &program) add_options(program, command.options);
    for (const CLI::App* below : app.get_subcommands({}))
      command.below.emplace_back(below->get_name(), below->get_description());
    all.push_back(std::move(command));
    for (const CLI::App* below : app.get_subcommands({})) {
      std::vector<std::string> longer = words;
      longer.push_back(below->get_name());
      visit(*below, longer);
    }
  };
  visit(program, {});
  return all;
}

std::vector<std::string> words_offered(const OfferedCommand& command) {
  std::vector<std::string> words;
  for (const auto& [name, description] : command.below) words.push_back(name);
  for (const OfferedOption& option : command.options)
    words.insert(words.end(), option.names.begin(), option.names.end());
  return words;
}

/// In single quotes, for any of the shells.
std::string in_quotes(const std::string& text) {
  std::string safe = "'";
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return safe + "'";
}

}  // namespace

std::string bash_completion(const CLI::App& program) {
  std::string words, values;
  std::vector<std::string> commands;
  for (const OfferedCommand& command : offered(program)) {
    const std::string path = fmt::format("{}", fmt::join(command.words, " "));
    words += fmt::format("    {}) offered={};;\n", in_quotes(path),
                         in_quotes(fmt::format("{}", fmt::join(words_offered(command), " "))));
    if (!command.words.empty()) commands.push_back(in_quotes(path));
    for (const OfferedOption& option : command.options)
      for (const std::string& name : option.names)
        if (option.takes_value)
          values +=
              fmt::format("    {}) values={};;\n", in_quotes(path + " " + name),
                          in_quotes(option.values.empty() ? "FILE" : fmt::format("{}", fmt::join(option.values, " "))));
  }
  return fmt::format(R"(# Completion of wheatstone for bash.
_wheatstone() {{
  local current=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD - 1]}} path= word offered= values=
  COMPREPLY=()
  for word in "${{COMP_WORDS[@]:1:COMP_CWORD-1}}"; do
    case "${{path:+$path }}$word" in
    {}) path="${{path:+$path }}$word" ;;
    esac
  done
  case "$path $before" in
{}  esac
  case "$path" in
{}  esac
  if [[ $values == FILE ]]; then
    compopt -o default 2>/dev/null
  elif [[ -n $values ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$values" -- "$current")
  elif [[ $current == -* || -z $path || $path == synth || $path == measure || $path == study ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$offered" -- "$current")
  else
    compopt -o default 2>/dev/null
  fi
}}
complete -F _wheatstone wheatstone
)",
                     fmt::join(commands, " | "), values, words);
}

std::string zsh_completion(const CLI::App& program) {
  // Square brackets and colons have a meaning in the specifications of _arguments.
  const auto safe = [](const std::string& text) {
    std::string escaped;
    for (const char c : text) {
      if (c == '[' || c == ']' || c == ':' || c == '\\') escaped += '\\';
      escaped += c;
    }
    return escaped;
  };
  std::string functions;
  for (const OfferedCommand& command : offered(program)) {
    functions += fmt::format("_wheatstone{}() {{\n",
                             command.words.empty() ? "" : "_" + fmt::format("{}", fmt::join(command.words, "_")));
    std::string arguments;
    for (const OfferedOption& option : command.options) {
      std::string value;
      if (!option.values.empty()) {
        value = fmt::format(":value:({})", fmt::join(option.values, " "));
      } else if (option.takes_value) {
        value = ":value:_files";
      }
      for (const std::string& name : option.names)
        arguments += fmt::format(" \\\n    {}", in_quotes(name + "[" + safe(option.description) + "]" + value));
    }
    if (command.below.empty()) {
      functions += fmt::format("  _arguments{} '*:file:_files'\n}}\n", arguments);
      continue;
    }
    functions += fmt::format(
        "  local state\n  _arguments -C{} '1: :->command' '*:: :->rest'\n  case $state in\n  command)\n    local -a "
        "commands=(",
        arguments);
    for (const auto& [name, description] : command.below)
      functions += "\n      " + in_quotes(name + ":" + safe(description));
    functions += "\n    )\n    _describe command commands ;;\n  rest)\n    case $words[1] in\n";
    for (const auto& [name, description] : command.below)
      functions += fmt::format("    {0}) _wheatstone{1}_{0} ;;\n", name,
                               command.words.empty() ? "" : "_" + fmt::format("{}", fmt::join(command.words, "_")));
    functions += "    esac ;;\n  esac\n}\n";
  }
  return "#compdef wheatstone\n# Completion of wheatstone for zsh.\n" + functions + "_wheatstone \"$@\"\n";
}

std::string fish_completion(const CLI::App& program) {
  std::string lines = "# Completion of wheatstone for fish.\n";
  for (const OfferedCommand& command : offered(program)) {
    std::string condition;
    for (const std::string& word : command.words)
      condition += fmt::format("{}__fish_seen_subcommand_from {}", condition.empty() ? "" : "; and ", word);
    if (command.words.empty()) condition = "__fish_use_subcommand";
    if (!command.below.empty() && !command.words.empty()) {
      std::vector<std::string> kinds;
      for (const auto& [name, description] : command.below) kinds.push_back(name);
      condition += fmt::format("; and not __fish_seen_subcommand_from {}", fmt::join(kinds, " "));
    }
    for (const auto& [name, description] : command.below)
      lines += fmt::format("complete -c wheatstone -n {} -f -a {} -d {}\n", in_quotes(condition), name,
                           in_quotes(description));
    for (const OfferedOption& option : command.options) {
      std::string names;
      for (const std::string& name : option.names)
        names += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
      std::string value;
      if (!option.values.empty()) {
        value = fmt::format(" -x -a {}", in_quotes(fmt::format("{}", fmt::join(option.values, " "))));
      } else if (option.takes_value) {
        value = " -r";
      }
      lines += fmt::format("complete -c wheatstone -n {}{}{} -d {}\n", in_quotes(condition), names, value,
                           in_quotes(option.description));
    }
  }
  return lines;
}

}  // namespace wheatstone::packaging
