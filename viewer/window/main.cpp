// The program wheatstone-view: the window around a viewer's session.

#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <optional>

#include "cli/view_arguments.h"
#include "viewer/command_table.h"
#include "viewer/open_content.h"
#include "wheatstone/error.h"
#include "window.h"

namespace {

using namespace wheatstone;
using namespace wheatstone::viewer;

using cli::ViewArguments;

void list_commands() {
  for (const Command& command : command_table())
    fmt::print("{:<44} {:<22} {}\n", fmt::format("{} {}", command.name, command.arguments), command.keys, command.text);
}

QSize size_of_window(const std::string& text) {
  int width = 0, height = 0;
  char rest = 0;
  if (std::sscanf(text.c_str(), "%dx%d%c", &width, &height, &rest) != 2 || width < 64 || height < 64 || width > 16384 ||
      height > 16384)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--size: is '{}', expected WIDTHxHEIGHT, from 64x64 to 16384x16384", text));
  return {width, height};
}

void begin(Window& window, const ViewArguments& arguments) {
  for (const std::string& file : arguments.files)
    if (!std::filesystem::exists(file)) throw Error(ErrorKind::bad_input, fmt::format("{}: no such file", file));
  Session& session = window.viewer().session();
  if (!arguments.mode.empty()) run_line(window.viewer(), "mode " + arguments.mode);
  if (!arguments.display.empty()) run_command(window.viewer(), find_command("display"), {arguments.display});
  if (!arguments.style.empty()) run_command(window.viewer(), find_command("style"), {arguments.style});
  session.state.style.seed = arguments.seed;
  session.full_screen = arguments.full_screen;
  if (arguments.files.size() == 2 && are_eyes_of_one(arguments.files[0], arguments.files[1])) {
    session.items.emplace_back(arguments.files.begin(), arguments.files.end());
  } else {
    for (const auto& file : arguments.files) session.items.push_back({std::filesystem::path(file)});
  }
  window.viewer().open(0);
}

/// A script needs no screen. Qt ends the program where it finds none.
void choose_platform(const ViewArguments& arguments) {
  if (qEnvironmentVariableIsSet("QT_QPA_PLATFORM") || qEnvironmentVariableIsSet("DISPLAY") ||
      qEnvironmentVariableIsSet("WAYLAND_DISPLAY"))
    return;
  if (arguments.script.empty())
    throw Error(
        ErrorKind::cannot_read_write,
        "view: there is no screen: neither DISPLAY nor WAYLAND_DISPLAY is set; only --script works without one");
  qputenv("QT_QPA_PLATFORM", "offscreen");
}

int run(QApplication& application, const ViewArguments& arguments) {
  const QSize size = size_of_window(arguments.size);
  const bool offscreen = QApplication::platformName() == "offscreen";  // which has no OpenGL for widgets
  Window window({.with_opengl = !arguments.no_opengl && !offscreen, .with_dialogs = arguments.script.empty()});
  window.resize(size);
  begin(window, arguments);
  std::unique_ptr<Script> script;
  if (!arguments.script.empty()) script = std::make_unique<Script>(arguments.script, window.script_host());
  window.show();
  if (script) window.run(std::move(script));
  application.exec();
  return window.exit_code();
}

}  // namespace

int main(int argc, char** argv) {
  cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
  cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
  CLI::App program("Look at paintings, photographs, slices and particles in a window", "wheatstone-view");
  ViewArguments arguments;
  cli::add_view_options(program, arguments);
  program.add_option("--threads", arguments.threads, "Number of threads; 0 uses all processors");
  program.add_option("--seed", arguments.seed, "Random seed of styles");
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "wheatstone: {}; see 'wheatstone view --help'\n", error.what());
    return static_cast<int>(ErrorKind::wrong_usage);
  }
  if (arguments.commands) {
    list_commands();
    return 0;
  }
  try {
    // What Qt's platforms lack is not told; what goes wrong here is one line of ours.
    qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
    choose_platform(arguments);
    int none = 1;
    QApplication application(none, argv);
    QApplication::setApplicationName("Wheatstone");
    return run(application, arguments);
  } catch (const Error& error) {
    fmt::print(stderr, "wheatstone: {}\n", error.what());
    return static_cast<int>(error.kind());
  }
}
