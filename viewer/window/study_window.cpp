#include "study_window.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLWidget>
#include <QScreen>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <memory>

#include "cli/failure.h"
#include "cli/interrupt.h"
#include "cli/report.h"
#include "cli/window_program.h"
#include "event_loop.h"
#include "viewer/compose.h"
#include "wheatstone/app/output_folder.h"
#include "wheatstone/error.h"
#include "wheatstone/study/study_folder.h"

namespace wheatstone::viewer {
namespace {

constexpr float step_of_key_mm = 10;
constexpr float mm_of_eye_separation = 65;  // in which the tracker counts
constexpr float nearest_mm = 200;           // a head that is said to be in the screen is not
constexpr int follow_every_ms = 8;

double now_s() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// When the window system saw the key. Its clock is ours where the server runs on this machine; another one's is of no
/// use.
double pressed_s(const QKeyEvent& event, double noted_s) {
  const double at_s = static_cast<double>(event.timestamp()) / 1000;
  return at_s <= noted_s + 0.001 && noted_s - at_s < 1 ? std::min(at_s, noted_s) : noted_s;
}

std::string key_name(const QKeyEvent& event) {
  if (event.key() == Qt::Key_Space) return "space";
  return event.text().toLower().toStdString();
}

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
  const EndSignals end_signals([] { QApplication::exit(static_cast<int>(ErrorKind::interrupted)); });
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

StudyWindow::StudyWindow(StudyRunner& runner, const StudyWindowOptions& options)
    : runner_(runner), options_(options), page_(new QLabel(this)), head_{0, options.viewing_distance_mm} {
  QString why_not;
  surface_ = make_surface(options.opengl, why_not);
  surface_->widget()->setParent(this);
  surface_->widget()->hide();
  // Frames are shown when buffers were swapped; without OpenGL, when they were painted.
  if (auto* const opengl = qobject_cast<QOpenGLWidget*>(surface_->widget()))
    connect(opengl, &QOpenGLWidget::frameSwapped, this, [this] { frame_is_shown(); });
  else
    surface_->widget()->installEventFilter(this);
  page_->installEventFilter(this);
  page_->setWordWrap(true);
  page_->setAlignment(Qt::AlignCenter);
  page_->setMargin(80);
  page_->setStyleSheet("background: #606060; color: white; font-size: 22px");
  surface_->pointed_at()->installEventFilter(this);
  surface_->widget()->setMouseTracking(true);
  setCursor(Qt::BlankCursor);
  setWindowTitle("Wheatstone");
  connect(&following_, &QTimer::timeout, this, [this] { follow_head(); });
}

StudyWindow::~StudyWindow() = default;

template <class Action>
void StudyWindow::guarded(Action action) {
  try {
    action();
  } catch (...) {
    const Ranks::Failure failure = cli::failure_of(std::current_exception());
    fmt::print(stderr, "wheatstone: {}\n", cli::one_line(failure.message));
    end(failure.exit_code);
  }
}

void StudyWindow::begin() {
  tell(runner_.beginning());
  guarded([this] { show_page(); });
  following_.start(follow_every_ms);
}

void StudyWindow::end(int exit_code) {
  exit_code_ = exit_code;
  following_.stop();
  QApplication::exit(exit_code);
}

void StudyWindow::tell(const std::string& line) {
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

void StudyWindow::resizeEvent(QResizeEvent* /*event*/) {
  page_->setGeometry(rect());
  surface_->widget()->setGeometry(rect());
}

void StudyWindow::show_page() {
  if (runner_.is_finished()) {
    end(0);
    return;
  }
  waits_for_frame_ = true;
  if (runner_.shows_stimulus()) {
    runner_.views_changed();
    show_stimulus();
    page_->hide();
    surface_->widget()->show();
  } else {
    page_->setText(QString::fromStdString(runner_.text()));
    surface_->widget()->hide();
    page_->show();
    page_->update();
  }
}

void StudyWindow::show_stimulus() {
  StereoPair pair = runner_.draw();
  surface_->show(compose(*options_.mode, std::move(pair.left), std::move(pair.right), viewport_of(*this)));
}

void StudyWindow::frame_is_shown() {
  if (!std::exchange(waits_for_frame_, false)) return;
  runner_.shown(now_s());
}

void StudyWindow::follow_head() {
  if (tracker_)
    if (const std::optional<float> place = tracker_->newest(now_s(), {}))
      head_ = {mm_of_eye_separation * *place,
               std::max(nearest_mm, options_.viewing_distance_mm + static_cast<float>(10 * tracker_->farther_cm()))};
  runner_.head_at(head_, now_s());
  if (runner_.views_changed()) guarded([this] { show_stimulus(); });
}

bool StudyWindow::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::Paint) {
    // Once it is painted and on its way to the screen.
    QTimer::singleShot(0, this, [this] { frame_is_shown(); });
  } else if (event->type() == QEvent::MouseMove && options_.head_by_pointer && width() > 0) {
    const double share = static_cast<const QMouseEvent*>(event)->position().x() / width() - 0.5;
    head_.x_mm = static_cast<float>(share * options_.pointer_range_mm);
  }
  return QWidget::eventFilter(watched, event);
}

void StudyWindow::keyPressEvent(QKeyEvent* event) {
  const double noted_s = now_s();
  if (event->key() == Qt::Key_Escape) {
    end(static_cast<int>(ErrorKind::interrupted));
  } else if (event->key() == Qt::Key_Left || event->key() == Qt::Key_Right) {
    head_.x_mm += event->key() == Qt::Key_Left ? -step_of_key_mm : step_of_key_mm;
  } else if (!event->isAutoRepeat()) {
    guarded([&] {
      if (!runner_.key(key_name(*event), pressed_s(*event, noted_s), noted_s)) return;
      tell(runner_.progress());
      show_page();
    });
  }
}

int run_study(int argc, char** argv) {
  CLI::App program("Run a subject's session of a study", "wheatstone-view study");
  StudyRunArguments arguments;
  cli::add_rows(program, cli::study_run_rows(arguments));
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
