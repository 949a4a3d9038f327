#include "manual_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>
#include <vector>

namespace wheatstone::packaging {
namespace {

/// Text as groff shows it: a leading point or apostrophe is no request, a hyphen can be copied into a command.
std::string plain(const std::string& text) {
  std::string shown;
  for (const char c : text) {
    if (c == '\\') {
      shown += "\\e";
    } else if (c == '-') {
      shown += "\\-";
    } else if ((c == '.' || c == '\'') && (shown.empty() || shown.back() == '\n')) {
      shown += "\\&";
      shown += c;
    } else {
      shown += c;
    }
  }
  return shown;
}

std::string bold(const std::string& text) { return "\\fB" + plain(text) + "\\fR"; }
std::string slanted(const std::string& text) { return "\\fI" + plain(text) + "\\fR"; }

std::string page_name(const CLI::App& command) {
  std::string name = words_of(command);
  std::ranges::replace(name, ' ', '-');
  return name;
}

/// "-o, --output FILE".
std::string heading_of(const CLI::Option& option) {
  std::string names;
  const auto add = [&](const std::string& name) { names += (names.empty() ? "" : ", ") + bold(name); };
  for (const std::string& name : option.get_snames()) add("-" + name);
  for (const std::string& name : option.get_lnames()) add("--" + name);
  if (option.get_items_expected_max() > 0 && !option.get_type_name().empty())
    names += " " + slanted(option.get_type_name());
  return names;
}

std::string described(const CLI::Option& option) {
  std::string text = plain(option.get_description());
  if (!option.get_default_str().empty()) text += fmt::format(" (default: {})", plain(option.get_default_str()));
  return text;
}

/// All but those of these names.
std::string options_of(const CLI::App& command, const std::vector<std::string>& left_out = {}) {
  std::string text;
  for (const std::string& group : command.get_groups()) {
    const std::vector<const CLI::Option*> options = command.get_options([&](const CLI::Option* option) {
      return option->nonpositional() && option->get_group() == group && !group.empty() &&
             std::ranges::none_of(left_out, [&](const std::string& name) { return option->check_lname(name); });
    });
    if (options.empty()) continue;
    if (group != "Options") text += fmt::format(".SS {}\n", plain(group));
    for (const CLI::Option* option : options)
      text += fmt::format(".TP\n{}\n{}\n", heading_of(*option), described(*option));
  }
  return text;
}

std::string arguments_of(const CLI::App& command) {
  std::string text;
  for (const CLI::Option* argument :
       command.get_options([](const CLI::Option* option) { return option->get_positional(); }))
    text += fmt::format(".TP\n{}\n{}\n", slanted(argument->get_name(true, false)), described(*argument));
  return text;
}

std::string synopsis_of(const CLI::App& command) {
  std::string text = bold(words_of(command));
  if (!command.get_subcommands({}).empty())
    return text + " " + slanted(command.get_parent() ? "KIND" : "COMMAND") + " ...";
  text += " [" + slanted("OPTION") + "]...";
  for (const CLI::Option* argument :
       command.get_options([](const CLI::Option* option) { return option->get_positional(); })) {
    const std::string name = slanted(argument->get_name(true, false));
    text += argument->get_required() ? " " + name : " [" + name + "]";
  }
  return text;
}

std::string commands_below(const CLI::App& command) {
  std::string text;
  for (const CLI::App* below : command.get_subcommands({}))
    text += fmt::format(".TP\n{}\n{}\n", bold(page_name(*below)) + "(1)", plain(below->get_description()));
  return text;
}

/// What stands below the options in the help: remarks, and examples from a line "Examples:" on.
struct Footer {
  std::string remarks, examples;
};

Footer footer_of(const CLI::App& command) {
  Footer footer;
  std::istringstream lines(command.get_footer());
  bool in_examples = false;
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' ');
    const std::string text = begin == std::string::npos ? "" : line.substr(begin);
    if (text.starts_with("Example:") || text.starts_with("Examples:")) {
      in_examples = true;
      continue;
    }
    if (in_examples) {
      footer.examples += plain(text) + "\n";
    } else {
      footer.remarks += text.empty() ? ".PP\n" : plain(text) + "\n";
    }
  }
  while (footer.remarks.ends_with(".PP\n")) footer.remarks.erase(footer.remarks.size() - 4);
  return footer;
}

std::string section(const char* title, const std::string& text) {
  return text.empty() ? "" : fmt::format(".SH {}\n{}{}", title, text, text.ends_with('\n') ? "" : "\n");
}

}  // namespace

std::string words_of(const CLI::App& command) {
  const CLI::App* parent = command.get_parent();
  return parent ? words_of(*parent) + " " + command.get_name() : command.get_name();
}

std::string manual_page(const CLI::App& command, const std::string& date, const std::string& version) {
  const std::string name = page_name(command);
  std::string upper = name;
  std::ranges::transform(upper, upper.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  const CLI::App* program = &command;
  while (program->get_parent()) program = program->get_parent();
  const Footer footer = footer_of(command);
  std::string page = fmt::format(".TH {} 1 {} \"Wheatstone {}\" \"Wheatstone manual\"\n", upper, date, version);
  page += section("NAME", plain(name) + " \\- " + plain(command.get_description()));
  page += section("SYNOPSIS", synopsis_of(command));
  page += section("DESCRIPTION",
                  plain(command.get_description()) + (footer.remarks.empty() ? "" : "\n.PP\n" + footer.remarks));
  page += section("ARGUMENTS", arguments_of(command));
  page += section(command.get_parent() ? "KINDS" : "COMMANDS", commands_below(command));
  std::string options = options_of(command);
  if (program != &command) options += ".SS Options of every command\n" + options_of(*program, {"help", "version"});
  page += section("OPTIONS", options);
  if (!footer.examples.empty()) page += section("EXAMPLES", ".nf\n" + footer.examples + ".fi\n");
  page += section("EXIT STATUS", "0 done, 2 wrong usage, 3 bad input, 4 cannot read or write, 5 interrupted.\n");
  if (command.get_parent()) page += section("SEE ALSO", bold(page_name(*command.get_parent())) + "(1)");
  return page;
}

}  // namespace wheatstone::packaging
