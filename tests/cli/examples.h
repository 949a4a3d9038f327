#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// Lines of examples that stand together, so that a line may use what the lines before it wrote.
struct ExampleBlock {
  std::string where;  ///< the page and line, or the command whose help has it
  std::vector<std::string> lines;
};

/// The code blocks of a Markdown page that hold command lines: indented blocks, and fenced blocks without a language.
std::vector<ExampleBlock> examples_of_page(const std::filesystem::path& page);

/// The examples at the end of a command's help: the indented lines below "Example:" or "Examples:".
std::vector<ExampleBlock> examples_of_help(const std::string& command, const std::string& help);

/// One command of a line: its words, and the file that takes its output (`> FILE`), empty if none does.
struct ExampleCommand {
  std::vector<std::string> words;
  std::string output_file;
};

/// The commands of a line, which `&&` separates, without the comment behind ` #`.
std::vector<ExampleCommand> commands_of_line(const std::string& line);

/// All options ("--style") that a text names.
std::set<std::string> options_named_in(std::string_view text);

}  // namespace wheatstone
