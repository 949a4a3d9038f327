#include <filesystem>

#include "commands.h"
#include "window_program.h"

namespace wheatstone::cli {
namespace {

Report run(const ViewArguments& arguments, const Session& session) {
  for (const std::string& file : arguments.files)
    if (!std::filesystem::exists(file) && file.find_first_of("%,") == std::string::npos)
      throw Error(ErrorKind::bad_input, fmt::format("{}: no such file", file));
  std::vector<std::string> words{"--threads", std::to_string(session.threads), "--seed", std::to_string(session.seed)};
  const std::vector<std::string> given = words_of(arguments.given);
  words.insert(words.end(), given.begin(), given.end());
  return run_window_program(std::move(words), session);
}

}  // namespace

Command view_command() {
  return make_command("view", "Open paintings, photographs, films, slices, particles or models in a window", view_rows,
                      run,
                      R"(
Click: what lies there comes onto the screen plane. Drag: pan, or turn particles or a model. Wheel: zoom.
?: all keys and commands.

Examples:
  wheatstone view painting.wst
  wheatstone view left.png right.png --style mosaic --mode left-right
  wheatstone view photographs
  wheatstone view film.mp4 --mode left-right
  wheatstone view universe.hdf5 --display looking-glass-portrait
  wheatstone view model.glb --mode red-cyan
  wheatstone view universe.hdf5 --camera path.toml --quantity column-density)");
}

}  // namespace wheatstone::cli
