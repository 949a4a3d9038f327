// The program wheatstone-view: the window around a viewer's session.

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>
#include <opencv2/core.hpp>
#include <opencv2/core/utils/logger.hpp>
#include <optional>
#include <string_view>
#include <thread>

#include "cli/failure.h"
#include "cli/interrupt.h"
#include "cli/report.h"
#include "cli/window_program.h"
#include "event_loop.h"
#include "kept_settings.h"
#include "study_window.h"
#include "viewer/command_table.h"
#include "viewer/control.h"
#include "wheatstone/app/process_memory.h"
#include "wheatstone/display/looking_glass_bridge.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"
#include "wheatstone/files/whole_file.h"
#include "window.h"

namespace wheatstone::viewer {
namespace {

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
    if (!std::filesystem::exists(file) && file.find_first_of("%,") == std::string::npos)
      throw Error(ErrorKind::bad_input, fmt::format("{}: no such file", file));
  Session& session = window.viewer().session();
  if (!arguments.mode.empty()) run_line(window.viewer(), "mode " + arguments.mode);
  const auto run = [&](const char* name, const std::string& value) {
    if (!value.empty()) run_command(window.viewer(), find_command(name), {value});
  };
  run("display", arguments.display);
  run("style", arguments.style);
  run("camera", arguments.camera);
  run("quantity", arguments.quantity);
  run("where", arguments.where);
  run("focus", arguments.focus);
  if (arguments.focus_radius) run("focus-radius", fmt::format("{}", *arguments.focus_radius));
  if (arguments.focus_gain) run("focus-gain", fmt::format("{}", *arguments.focus_gain));
  session.state.style.seed = arguments.seed;
  session.full_screen = arguments.full_screen;
  window.viewer().open_all({arguments.files.begin(), arguments.files.end()});
}

/// Leaves what threads do; what cannot be left soon ends with the program.
void end_threads(Viewer& viewer, int exit_code) {
  constexpr int longest_ms = 100;
  viewer.stop();
  // A signal ends the window within a second.
  if (exit_code == static_cast<int>(ErrorKind::interrupted))
    viewer.finish_saving(std::chrono::milliseconds(500));
  else
    viewer.finish_saving();
  for (int waited_ms = 0; viewer.is_working(); ++waited_ms) {
    if (waited_ms == longest_ms) {
      std::fflush(stdout);
      remove_unfinished_outputs();
      std::_Exit(exit_code);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

/// A script needs no screen. Qt ends the program where it finds none.
void choose_platform(const ViewArguments& arguments) {
  if (qEnvironmentVariableIsSet("QT_QPA_PLATFORM") || qEnvironmentVariableIsSet("DISPLAY") ||
      qEnvironmentVariableIsSet("WAYLAND_DISPLAY"))
    return;
  if (arguments.script.empty() && arguments.control.empty())
    throw Error(ErrorKind::cannot_read_write,
                "view: there is no screen: neither DISPLAY nor WAYLAND_DISPLAY is set; only --script and --control "
                "work without one");
  qputenv("QT_QPA_PLATFORM", "offscreen");
}

void write_bridge_calibration(const std::string& file) {
  constexpr unsigned longest_s = 30;  // the library was seen to need seven seconds
  // The library may hang, and who waits for this program tells of signals.
  cli::run_is_over();
  std::signal(SIGALRM, [](int) {
    constexpr std::string_view said = "wheatstone: Looking Glass Bridge does not answer\n";
    [[maybe_unused]] const auto written = ::write(STDERR_FILENO, said.data(), said.size());
    ::_exit(static_cast<int>(ErrorKind::cannot_read_write));
  });
  ::alarm(longest_s);
  write_whole_file(file, calibration_text(calibration_from_bridge(bridge_library())));
}

OpenglUse opengl_use(const ViewArguments& arguments) {
  const bool offscreen = QApplication::platformName() == "offscreen";  // which has no OpenGL for widgets
  if (arguments.no_opengl || offscreen) return OpenglUse::never;
  return arguments.opengl ? OpenglUse::always : OpenglUse::where_fast;
}

int run(const ViewArguments& arguments) {
  const QSize size = size_of_window(arguments.size);
  Window window({.opengl = opengl_use(arguments),
                 .stereo = arguments.stereo,
                 .with_dialogs = arguments.script.empty() && arguments.control.empty()});
  const EndSignals end_signals([&window] { window.end(static_cast<int>(ErrorKind::interrupted)); });
  window.resize(size);
  std::optional<KeptSettings> kept;
  if (arguments.script.empty() && arguments.control.empty()) {
    kept.emplace(window);
    kept->restore(arguments.size == ViewArguments().size);
  }
  begin(window, arguments);
  std::unique_ptr<Script> script;
  if (!arguments.script.empty()) script = std::make_unique<Script>(arguments.script, window.script_host());
  if (!arguments.control.empty()) window.listen(std::make_unique<Control>(arguments.control, window.script_host()));
  window.show();
  if (script) window.run(std::move(script));
  if (!window.viewer().session().ends) QApplication::exec();
  if (kept) kept->keep();
  const int exit_code = window.exit_code();
  if (exit_code == static_cast<int>(ErrorKind::interrupted)) cli::run_is_over(true);
  window.close_control();
  end_threads(window.viewer(), exit_code);
  return exit_code;
}

/// What Qt's platforms lack is not told. What ends the program is told in one line: a screen that cannot be opened,
/// above all.
void on_message_of_qt(QtMsgType type, const QMessageLogContext& /*context*/, const QString& message) {
  if (type != QtFatalMsg) return;
  const QByteArray wayland = qgetenv("WAYLAND_DISPLAY"), screen = wayland.isEmpty() ? qgetenv("DISPLAY") : wayland;
  if (QApplication::startingUp())
    fmt::print(stderr, "wheatstone: the screen '{}' cannot be opened; DISPLAY and WAYLAND_DISPLAY name it\n",
               screen.toStdString());
  else
    fmt::print(stderr, "wheatstone: the window failed: {}\n", message.simplified().toStdString());
  std::_Exit(static_cast<int>(ErrorKind::cannot_read_write));
}

int run_view(int argc, char** argv) {
  CLI::App program("Look at paintings, photographs, slices, particles and models in a window", "wheatstone-view");
  ViewArguments arguments;
  cli::add_rows(program, cli::view_rows(arguments));
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
  if (!arguments.bridge_calibration.empty()) {
    write_bridge_calibration(arguments.bridge_calibration);
    return 0;
  }
  choose_platform(arguments);
  int none = 1;
  const QApplication application(none, argv);
  use_plain_numbers();
  QApplication::setApplicationName("Wheatstone");
  return run(arguments);
}

}  // namespace
}  // namespace wheatstone::viewer

int main(int argc, char** argv) {
  wheatstone::cli::end_in_one_line(false);
  try {
    constexpr bool says_so = false;  // the command that started it does
    wheatstone::cli::watch_signals(says_so);
    cv::redirectError([](int, const char*, const char*, const char*, int, void*) { return 0; });
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    qInstallMessageHandler(wheatstone::viewer::on_message_of_qt);
    wheatstone::use_huge_pages();
    const bool is_study = argc > 1 && std::string_view(argv[1]) == "study";
    return is_study ? wheatstone::viewer::run_study(argc - 1, argv + 1) : wheatstone::viewer::run_view(argc, argv);
  } catch (...) {
    const wheatstone::Ranks::Failure failure = wheatstone::cli::failure_of(std::current_exception());
    if (failure.exit_code != static_cast<int>(wheatstone::ErrorKind::interrupted))
      std::fprintf(stderr, "wheatstone: %s\n", wheatstone::cli::one_line(failure.message).c_str());
    return failure.exit_code;
  }
}
