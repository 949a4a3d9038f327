#include "study.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QScreen>
#include <cstdio>
#include <filesystem>
#include <memory>

#include "cli/interrupt.h"
#include "cli/study_run_arguments.h"
#include "end_signals.h"
#include "plain_numbers.h"
#include "study_window.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/error.h"
#include "wheatstone/study/study_folder.h"

namespace wheatstone::viewer {
namespace {

using cli::StudyRunArguments;

const OutputMode& mode_of(const StudyRunArguments& arguments) {
  const OutputMode& mode = find_output_mode(arguments.mode);
  constexpr Viewport tried{400, 200};
  const PictureSize size = eye_size(mode, tried);
  if (shows_display_views(mode) || std::holds_alternative<Wiggle>(mode.kind) || size.width != tried.width ||
      size.height != tried.height)
    throw Error(
        ErrorKind::wrong_usage,
        fmt::format("--mode: is '{}', expected a mode in which each eye's picture fills the screen", arguments.mode));
  return mode;
}

QSize window_size(const StudyRunArguments& arguments, const QScreen& screen) {
  int width = 0, height = 0;
  if (arguments.size.empty()) return screen.size();
  if (std::sscanf(arguments.size.c_str(), "%dx%d", &width, &height) != 2 || width < 64 || height < 64)
    throw Error(ErrorKind::wrong_usage,
                fmt::format("--size: is '{}', expected WIDTHxHEIGHT from 64x64 on", arguments.size));
  return {width, height};
}

/// The window's part of the screen, in pixels of the screen and mm.
StudyScreen study_screen(const StudyRunArguments& arguments, const QScreen& screen, const QSize& window) {
  const double ratio = screen.devicePixelRatio();
  const int all_px = static_cast<int>(screen.size().width() * ratio);
  double all_mm = cli::screen_width_mm(arguments, all_px);
  if (all_mm <= 0) all_mm = screen.physicalSize().width();
  if (all_mm <= 0)
    throw Error(ErrorKind::wrong_usage, "--screen-width: the screen does not tell its width, expected it");
  StudyScreen shown{.width_px = static_cast<int>(window.width() * ratio),
                    .height_px = static_cast<int>(window.height() * ratio),
                    .viewing_distance_mm = static_cast<float>(arguments.distance_mm),
                    .eye_separation_mm = static_cast<float>(arguments.eye_separation_mm)};
  shown.width_mm = static_cast<float>(all_mm * shown.width_px / all_px);
  return shown;
}

/// A new study gets its name when its stimuli are there.
void begin_study(const std::filesystem::path& path, const StudyDesign& design, const StudyScreen& screen) {
  check_study_folder(path, design, false);
  if (holds_study(path)) return;
  OutputFolder output(path);
  const StudyFolder growing(output.folder(), design, false);
  if (design.items.empty()) growing.make_stimuli(screen);
  output.commit();
}

int run_session(const StudyRunArguments& arguments) {
  const StudyDesign design = load_study_design(arguments.design);
  check_subject(design, arguments.subject - 1);
  check_stimuli(arguments.folder, design);
  const QScreen& screen = *QApplication::primaryScreen();
  const QSize size = window_size(arguments, screen);
  const StudyScreen shown = study_screen(arguments, screen, size);
  begin_study(arguments.folder, design, shown);
  const StudyFolder folder(arguments.folder, design, false);
  StudyRunner runner(folder, arguments.subject - 1, shown);
  const OpenglUse opengl = arguments.no_opengl || QApplication::platformName() == "offscreen" ? OpenglUse::never
                           : arguments.opengl                                                 ? OpenglUse::always
                                                                                              : OpenglUse::where_fast;
  StudyWindow window(runner, {.mode = &mode_of(arguments),
                              .opengl = opengl,
                              .head_by_pointer = arguments.pointer,
                              .viewing_distance_mm = static_cast<float>(arguments.distance_mm)});
  if (arguments.tracker_port >= 0)
    window.track(std::make_unique<HeadTracker>(static_cast<std::uint16_t>(arguments.tracker_port)));
  const EndSignals end_signals([] {
    fmt::print(stderr, "wheatstone: the session was broken off; run it again to go on\n");
    QApplication::exit(static_cast<int>(ErrorKind::interrupted));
  });
  window.resize(size);
  if (arguments.size.empty())
    window.showFullScreen();
  else
    window.show();
  window.activateWindow();
  // A session that was finished before ends at once.
  QTimer::singleShot(0, &window, [&window] { window.begin(); });
  const int exit_code = QApplication::exec();
  cli::run_is_over(true);
  return exit_code;
}

}  // namespace

int run_study(int argc, char** argv) {
  CLI::App program("Run a subject's session of a study", "wheatstone-view study");
  StudyRunArguments arguments;
  cli::add_study_run_options(program, arguments);
  try {
    program.parse(argc, argv);
  } catch (const CLI::CallForHelp& help) {
    return program.exit(help);
  } catch (const CLI::ParseError& error) {
    fmt::print(stderr, "wheatstone: {}; see 'wheatstone study run --help'\n", error.what());
    return static_cast<int>(ErrorKind::wrong_usage);
  }
  mode_of(arguments);
  if (!qEnvironmentVariableIsSet("QT_QPA_PLATFORM") && !qEnvironmentVariableIsSet("DISPLAY") &&
      !qEnvironmentVariableIsSet("WAYLAND_DISPLAY"))
    throw Error(ErrorKind::cannot_read_write,
                "study run: there is no screen: neither DISPLAY nor WAYLAND_DISPLAY is set");
  int none = 1;
  const QApplication application(none, argv);
  use_plain_numbers();
  return run_session(arguments);
}

}  // namespace wheatstone::viewer
