// Writes what describes the program to others, from the program's own table of commands: manual pages, and completions
// for bash, zsh and fish.
//
//   wheatstone_describe FOLDER DATE

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iostream>
#include <string>

#include "cli/program.h"
#include "completion.h"
#include "manual_page.h"
#include "wheatstone/error.h"
#include "wheatstone/files/whole_file.h"

namespace {

using namespace wheatstone;

void describe(const std::filesystem::path& folder, const std::string& date) {
  cli::Session session{.output = std::cout, .errors = std::cerr};
  const std::unique_ptr<CLI::App> program = cli::make_program(session);
  for (const char* kind : {"man", "bash", "zsh", "fish"}) std::filesystem::create_directories(folder / kind);
  const std::function<void(const CLI::App&)> write_pages = [&](const CLI::App& command) {
    std::string name = packaging::words_of(command);
    std::ranges::replace(name, ' ', '-');
    write_whole_file(folder / "man" / (name + ".1"), packaging::manual_page(command, date, WHEATSTONE_VERSION));
    for (const CLI::App* below : command.get_subcommands({})) write_pages(*below);
  };
  write_pages(*program);
  write_whole_file(folder / "bash" / "wheatstone", packaging::bash_completion(*program));
  write_whole_file(folder / "zsh" / "_wheatstone", packaging::zsh_completion(*program));
  write_whole_file(folder / "fish" / "wheatstone.fish", packaging::fish_completion(*program));
}

}  // namespace

int main(int count, char** words) {
  if (count != 3) {
    std::cerr << "usage: wheatstone_describe FOLDER DATE\n";
    return 2;
  }
  try {
    describe(words[1], words[2]);
  } catch (const std::exception& error) {
    std::cerr << "wheatstone_describe: " << error.what() << '\n';
    return 1;
  }
  return 0;
}
