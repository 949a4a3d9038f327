#include <fmt/format.h>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "command.h"
#include "view_arguments.h"
#include "wheatstone/error.h"
#include "window_program.h"

namespace wheatstone::cli {
namespace {

namespace fs = std::filesystem;

void view(const ViewArguments& arguments, const CLI::App& command, const Session& session) {
  for (const std::string& file : arguments.files)
    if (!fs::exists(file) && file.find_first_of("%,") == std::string::npos)
      throw Error(ErrorKind::bad_input, fmt::format("{}: no such file", file));
  session.output.flush();
  std::vector<std::string> words{"--threads", std::to_string(session.threads), "--seed", std::to_string(session.seed)};
  const std::vector<std::string> given = view_words(command);
  words.insert(words.end(), given.begin(), given.end());
  if (const int code = run_window_program(std::move(words)); code != 0) throw ErrorTold{code};
}

}  // namespace

void add_view_command(CLI::App& program, const Session& session) {
  CLI::App* const command =
      program.add_subcommand("view", "Open paintings, photographs, films, slices or particles in a window");
  const auto arguments = std::make_shared<ViewArguments>();
  add_view_options(*command, *arguments);
  command->callback([arguments, command, &session] { view(*arguments, *command, session); });
}

}  // namespace wheatstone::cli
