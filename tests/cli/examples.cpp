#include "cli/examples.h"

#include <fmt/format.h>

#include <cctype>
#include <fstream>
#include <sstream>

namespace wheatstone {
namespace {

bool is_blank(const std::string& line) { return line.find_first_not_of(' ') == std::string::npos; }

std::string without_indent(const std::string& line) {
  return is_blank(line) ? std::string() : line.substr(line.find_first_not_of(' '));
}

/// Adds a line to a block; one that ends with a backslash goes on in the next.
void add_line(const std::string& line, ExampleBlock& block) {
  if (!block.lines.empty() && block.lines.back().ends_with('\\')) {
    block.lines.back().back() = ' ';
    block.lines.back() += without_indent(line);
  } else {
    block.lines.push_back(without_indent(line));
  }
}

/// A word as a shell sees it; quotes may stand around it or a part of it.
struct ShellWord {
  std::string text;
  bool quoted = false;
};

/// The words of a line, up to a comment.
std::vector<ShellWord> shell_words(const std::string& line) {
  std::vector<ShellWord> words;
  bool in_word = false;
  char quote = 0;
  for (const char c : line) {
    if (quote == 0 && c == ' ') {
      in_word = false;
      continue;
    }
    if (!in_word && c == '#') break;
    if (!in_word) words.emplace_back();
    in_word = true;
    if (quote == 0 && (c == '\'' || c == '"')) {
      quote = c;
      words.back().quoted = true;
    } else if (c == quote) {
      quote = 0;
    } else {
      words.back().text += c;
    }
  }
  return words;
}

}  // namespace

std::vector<ExampleBlock> examples_of_page(const std::filesystem::path& page) {
  std::vector<ExampleBlock> blocks;
  std::ifstream file(page);
  bool in_fence = false;
  bool fence_has_commands = false;
  bool in_block = false;
  bool after_blank = true;
  int number = 0;
  for (std::string line; std::getline(file, line);) {
    ++number;
    if (without_indent(line).starts_with("```")) {
      in_fence = !in_fence;
      fence_has_commands = in_fence && without_indent(line) == "```";
      in_block = false;
      continue;
    }
    const bool is_code = in_fence ? fence_has_commands && !is_blank(line)
                                  : line.starts_with("    ") && !is_blank(line) && (in_block || after_blank);
    if (is_code && !in_block) blocks.push_back({fmt::format("{}:{}", page.filename().string(), number), {}});
    if (is_code) add_line(line, blocks.back());
    in_block = is_code;
    after_blank = is_blank(line);
  }
  return blocks;
}

std::vector<ExampleBlock> examples_of_help(const std::string& command, const std::string& help) {
  ExampleBlock block{command + " --help", {}};
  std::istringstream text(help);
  bool in_examples = false;
  for (std::string line; std::getline(text, line);) {
    if (line.starts_with("Example")) {
      in_examples = true;
    } else if (!line.starts_with("  ")) {
      in_examples = false;
    } else if (in_examples) {
      add_line(line, block);
    }
  }
  if (block.lines.empty()) return {};
  return {block};
}

std::vector<ExampleCommand> commands_of_line(const std::string& line) {
  std::vector<ExampleCommand> commands(1);
  bool into_file = false;
  for (const ShellWord& word : shell_words(line)) {
    if (!word.quoted && word.text == "&&") {
      commands.emplace_back();
    } else if (!word.quoted && word.text == ">") {
      into_file = true;
    } else if (into_file) {
      commands.back().output_file = word.text;
      into_file = false;
    } else {
      commands.back().words.push_back(word.text);
    }
  }
  return commands;
}

std::set<std::string> options_named_in(std::string_view text) {
  const auto is_part = [](char c) { return c == '-' || c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
  std::set<std::string> options;
  for (std::size_t at = text.find("--"); at != std::string_view::npos; at = text.find("--", at)) {
    std::size_t end = at + 2;
    while (end < text.size() && is_part(text[end])) ++end;
    const bool begins_a_word = at == 0 || !is_part(text[at - 1]);
    const bool is_option = end > at + 2 && std::islower(static_cast<unsigned char>(text[at + 2])) != 0;
    if (begins_a_word && is_option) options.emplace(text.substr(at, end - at));
    at = end;
  }
  return options;
}

}  // namespace wheatstone
