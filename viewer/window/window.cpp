#include "window.h"

#include <fmt/format.h>

#include <QAbstractSpinBox>
#include <QApplication>
#include <QCloseEvent>
#include <QDragEnterEvent>
#include <QFileDialog>
#include <QFileInfo>
#include <QLabel>
#include <QLineEdit>
#include <QMenuBar>
#include <QMessageBox>
#include <QMimeData>
#include <QMouseEvent>
#include <QProgressBar>
#include <QStackedWidget>
#include <QStatusBar>
#include <cmath>
#include <utility>

#include "help_page.h"
#include "information.h"
#include "picture_surface.h"
#include "save_dialog.h"
#include "theme.h"
#include "viewer/depth_seen.h"
#include "viewer/orbit.h"
#include "wheatstone/error.h"
#include "wheatstone/pictures/write_image.h"

namespace wheatstone::viewer {
namespace {

constexpr int drag_begins_px = 4;
constexpr int click_delay_ms = 200;  ///< in which a second click makes it a double click
constexpr double degrees_a_pixel = 0.4;

Image<Rgb8> image_of(const QImage& grabbed) {
  const QImage plain = grabbed.convertToFormat(QImage::Format_RGB888);
  Image<Rgb8> image(plain.width(), plain.height());
  for (int y = 0; y < plain.height(); ++y)
    std::memcpy(image.row(y).data(), plain.constScanLine(y), static_cast<std::size_t>(plain.width()) * sizeof(Rgb8));
  return image;
}

}  // namespace

Window::Window(const WindowOptions& options)
    : options_(options), viewer_([this] {
        QMetaObject::invokeMethod(
            this, [this] { refresh(); }, Qt::QueuedConnection);
      }) {
  setWindowTitle("Wheatstone");
  setAcceptDrops(true);
  QString why_not;
  surface_ = options.stereo ? make_stereo_surface() : make_surface(options.opengl, why_not);
  QWidget* const picture = surface_->widget();
  picture->setMinimumSize(64, 48);
  picture->setMouseTracking(true);
  picture->setFocusPolicy(Qt::StrongFocus);
  picture->setAccessibleName("Picture");
  start_page_ = new StartPage([this](const std::string& name, const Words& words) { do_line(name, words); },
                              [this] { menus_->ask(find_command("open")); });
  pages_ = new QStackedWidget(this);
  pages_->addWidget(start_page_);
  pages_->addWidget(picture);
  setCentralWidget(pages_);
  information_ = make_information(picture);
  help_ = make_help_page(this, [this] {
    viewer_.session().help = false;
    refresh();
  });
  brush_ = std::make_unique<BrushPointer>(
      viewer_, [this](const std::string& name, const Words& arguments) { do_line(name, arguments); });
  panels_ = std::make_unique<Panels>(
      *this, [this](const std::string& name, const Words& arguments) { do_in_panel(name, arguments); });
  menus_ = std::make_unique<Menus>(*this, [this](const Command& command, const Words& words) {
    if (!words.empty()) return do_command(command, words);
    if (const std::optional<Words> asked = ask_for_arguments(command)) do_command(command, *asked);
  });
  make_status_bar();
  film_bar_ = new FilmBar(this, [this](const std::string& name, const Words& words) { do_line(name, words); });
  addToolBar(Qt::BottomToolBarArea, film_bar_);
  film_bar_->hide();
  // Last of the parts: an event reaches the brush and the panels, and Qt sends some while parts are put together.
  picture->installEventFilter(this);
  if (surface_->pointed_at() != picture) surface_->pointed_at()->installEventFilter(this);
  if (!why_not.isEmpty()) {
    viewer_.tell(why_not.toStdString() + "; the processor draws instead");
    if (options.with_dialogs) QMessageBox::warning(this, "Wheatstone", why_not + ". The processor draws instead.");
  }
  for (QTimer* timer : {&step_timer_, &click_timer_}) timer->setSingleShot(true);
  connect(&step_timer_, &QTimer::timeout, this, [this] { refresh(); });
  script_timer_.setInterval(2);
  connect(&script_timer_, &QTimer::timeout, this, [this] { go_on_with_script(); });
  viewer_.session().stereo = options.stereo;
  const auto count_screens = [this] {
    viewer_.session().screens = static_cast<int>(QGuiApplication::screens().size());
    viewer_.session().screen = 0;
    filled_screen_ = 0;
  };
  count_screens();
  connect(qApp, &QGuiApplication::screenAdded, this, count_screens);
  connect(qApp, &QGuiApplication::screenRemoved, this, [this, count_screens](const QScreen* removed) {
    count_screens();
    if (full_screen_.screen_removed(*this, removed)) viewer_.session().full_screen = false;
    refresh();
  });
  connect(&click_timer_, &QTimer::timeout, this, [this] {
    do_line("zero-parallax-at", {fmt::format("{}", pressed_at_.x()), fmt::format("{}", pressed_at_.y())});
  });
}

// Widgets tell of their end, too, when what their events are passed to is gone.
Window::~Window() {
  surface_->widget()->removeEventFilter(this);
  surface_->pointed_at()->removeEventFilter(this);
}

void Window::make_status_bar() {
  message_ = new QLabel(this);
  message_->setTextInteractionFlags(Qt::TextSelectableByMouse);
  message_->setSizePolicy(QSizePolicy::Ignored, QSizePolicy::Preferred);
  // One that never had a text is as wide as a letter: then what stands beside it would depend on what was shown before.
  depth_ = new QLabel(" ", this);
  progress_ = new QProgressBar(this);
  progress_->setMaximumWidth(220);
  progress_->hide();
  statusBar()->addWidget(message_, 1);
  place_ = new QLabel(this);
  place_->setToolTip("Which of the folder's photographs and paintings is open");
  statusBar()->addPermanentWidget(place_);
  tracker_ = new QLabel(this);
  tracker_->setToolTip("Head tracker");
  statusBar()->addPermanentWidget(tracker_);
  statusBar()->addPermanentWidget(progress_);
  depth_->setToolTip("Disparity under the pointer, and where it seems to be on the display");
  comfort_ = new QLabel(this);
  statusBar()->addPermanentWidget(comfort_);
  statusBar()->addPermanentWidget(depth_);
}

std::optional<Words> Window::ask_for_arguments(const Command& command) {
  if (command.arguments.empty()) return Words();
  const QString title = QString::fromStdString(title_of(command));
  Session& session = viewer_.session();
  const QString folder = QString::fromStdString(session.folder.string());
  QStringList files;
  if (command.name == "save-as") return ask_how_to_save(*this, session);
  if (command.name == "open") {
    files = QFileDialog::getOpenFileNames(this, title, folder);
  } else if (command.name == "open-folder") {
    files << QFileDialog::getExistingDirectory(this, title, folder);
  } else if (command.name == "camera" || command.name == "style") {
    files << QFileDialog::getOpenFileName(this, title, folder, "TOML (*.toml)");
  } else {
    files << QFileDialog::getSaveFileName(
        this, title, QString::fromStdString((session.folder / proposed_name(session, command.name)).string()));
  }
  files.removeAll(QString());
  if (files.empty()) return {};
  session.folder = QFileInfo(files.front()).absolutePath().toStdString();
  Words words;
  for (const QString& file : files) words.push_back(file.toStdString());
  return words;
}

void Window::do_command(const Command& command, const Words& arguments) {
  try {
    run_command(viewer_, command, arguments);
    if (command.name == "copy-command") copy_to_clipboard(viewer_.session().message);
  } catch (const Error& error) {
    viewer_.tell(error.what(), true);
  }
  refresh();
}

void Window::do_line(const std::string& name, const Words& arguments) { do_command(find_command(name), arguments); }

void Window::do_in_panel(const std::string& name, const Words& arguments) {
  do_line(name, arguments);
  // What is being typed is typed to its end.
  const QWidget* const typed_in = QApplication::focusWidget();
  if (qobject_cast<const QLineEdit*>(typed_in) == nullptr && qobject_cast<const QAbstractSpinBox*>(typed_in) == nullptr)
    surface_->widget()->setFocus();
}

void Window::refresh() {
  viewer_.set_viewport(viewport_of(*surface_->widget()));
  viewer_.collect();
  if (viewer_.frames_drawn() != shown_frame_) {
    shown_frame_ = viewer_.frames_drawn();
    surface_->show(*viewer_.frame());
    show_depth_under_pointer();
  }
  show_session();
  if (const std::optional<double> next_s = viewer_.next_step_s()) step_timer_.start(static_cast<int>(*next_s * 1000));
}

void Window::show_session() {
  const Session& session = viewer_.session();
  if (std::exchange(shown_theme_, session.theme) != session.theme)
    QApplication::setPalette(palette_of(session.theme, desktop_palette_));
  const bool shows_something = !std::holds_alternative<std::monostate>(session.opened.content);
  if (const Item* const item = open_item(session))
    setWindowTitle((shows_something || !session.opening ? "" : "Opening ") +
                   QString::fromStdString(item->front().filename().string()) + " – Wheatstone");
  else
    setWindowTitle("Wheatstone");
  message_->setText(QString::fromStdString(session.message));
  message_->setToolTip(message_->text());
  place_->setText(QString::fromStdString(place_told(session)));
  place_->setVisible(!place_->text().isEmpty());
  tracker_->setText(QString::fromStdString(head_tracker_text(session)));
  progress_->setVisible(session.opening.has_value());
  if (session.opening) {
    progress_->setFormat(QString::fromStdString(session.opening->step));
    progress_->setValue(static_cast<int>(100 * session.opening->done));
  }
  if (session.full_screen != full_screen_.is_on() || (session.full_screen && session.screen != filled_screen_)) {
    filled_screen_ = session.screen;
    menuBar()->setVisible(!session.full_screen);
    statusBar()->setVisible(!session.full_screen);
    menus_->toolbar().setVisible(!session.full_screen);
    if (session.full_screen) {
      full_screen_.enter(*this, *screen_to_fill(session, *this));
    } else {
      full_screen_.leave(*this);
      viewer_.session().screen = 0;
    }
  }
  film_bar_->show_session(session);
  show_information(*information_, session);
  comfort_->setText(QString::fromStdString(comfort_in_short(viewer_)));
  comfort_->setToolTip(QString::fromStdString(comfort_told(viewer_)));
  panels_->show(viewer_);
  menus_->show(viewer_);
  brush_->show(*surface_->widget(), surface_->widget()->devicePixelRatioF());
  const bool is_empty = !shows_something && !session.opening;
  QWidget* const page = is_empty ? static_cast<QWidget*>(start_page_) : surface_->widget();
  if (pages_->currentWidget() != page) {
    pages_->setCurrentWidget(page);
    if (!is_empty) page->setFocus();
  }
  start_page_->show_session(session);
  help_->setVisible(session.help);
  if (session.ends) close();
}

void Window::show_depth_under_pointer() {
  depth_->setText(QString::fromStdString(depth_told(viewer_, pointer_.x(), pointer_.y())));
}

bool Window::eventFilter(QObject* watched, QEvent* event) {
  if (watched != surface_->widget() && watched != surface_->pointed_at())
    return QMainWindow::eventFilter(watched, event);
  if (event->type() == QEvent::Resize) refresh();
  if (compares_while_held(event)) return true;
  return pointer_event(event) || QMainWindow::eventFilter(watched, event);
}

bool Window::compares_while_held(QEvent* event) {
  if (event->type() != QEvent::KeyPress && event->type() != QEvent::KeyRelease) return false;
  const auto* const key = static_cast<QKeyEvent*>(event);
  if (key->key() != Qt::Key_C || key->modifiers() != Qt::NoModifier) return false;
  if (!key->isAutoRepeat()) do_line("compare", {event->type() == QEvent::KeyPress ? "photograph" : "painting"});
  return true;
}

bool Window::pointer_event(QEvent* event) {
  const double ratio = surface_->widget()->devicePixelRatioF();
  if (event->type() == QEvent::MouseMove) {
    pointer_ = static_cast<QMouseEvent*>(event)->position() * ratio;
    show_depth_under_pointer();
  }
  if (brush_->take(event, ratio)) return true;
  switch (event->type()) {
    case QEvent::MouseButtonPress: {
      is_pressed_ = true;
      is_dragged_ = false;
      const auto* const mouse = static_cast<QMouseEvent*>(event);
      pans_ = mouse->button() == Qt::MiddleButton || mouse->modifiers().testFlag(Qt::ShiftModifier);
      pressed_at_ = dragged_to_ = mouse->position() * ratio;
      held_plane_ = viewer_.frame() == nullptr || pans_
                        ? std::nullopt
                        : plane_at(viewer_.frame()->planes, pressed_at_.x(), pressed_at_.y());
      return true;
    }
    case QEvent::MouseMove: {
      if (is_pressed_) {
        drag_to(pointer_);
      } else if (viewer_.session().gaze_follows_pointer && viewer_.frame() != nullptr) {
        do_line("gaze", {fmt::format("{}", pointer_.x()), fmt::format("{}", pointer_.y())});
      }
      return true;
    }
    case QEvent::MouseButtonRelease: {
      if (!std::exchange(is_pressed_, false) || is_dragged_) return true;
      const Qt::KeyboardModifiers held = static_cast<QMouseEvent*>(event)->modifiers();
      if (held.testFlag(Qt::ControlModifier) && held.testFlag(Qt::ShiftModifier)) {
        do_line("focus-at", {fmt::format("{}", pressed_at_.x()), fmt::format("{}", pressed_at_.y())});
      } else if (!held.testFlag(Qt::ControlModifier)) {
        click_timer_.start(click_delay_ms);
      } else if (turns_around(viewer_)) {
        do_line("look-at-place", {fmt::format("{}", pressed_at_.x()), fmt::format("{}", pressed_at_.y())});
      }
      return true;
    }
    case QEvent::MouseButtonDblClick: {
      click_timer_.stop();
      is_pressed_ = false;
      do_line("full-screen", {});
      return true;
    }
    case QEvent::Leave: {
      pointer_ = QPointF(-1, -1);
      show_depth_under_pointer();
      return true;
    }
    case QEvent::Wheel:
      turn_wheel(*static_cast<QWheelEvent*>(event), ratio);
      return true;
    default:
      return false;
  }
}

void Window::turn_wheel(const QWheelEvent& wheel, double ratio) {
  const double steps = wheel.angleDelta().y() / 120.;
  // With Alt, a wheel turns sideways.
  if (const int aside = wheel.angleDelta().x(); wheel.modifiers().testFlag(Qt::AltModifier) && aside != 0) {
    do_line(aside > 0 ? "slice-nearer" : "slice-farther", {});
  } else if (wheel.modifiers().testFlag(Qt::ControlModifier)) {
    do_line(steps > 0 ? "more-detail" : "less-detail", {});
  } else if (steps != 0) {
    const QPointF place = wheel.position() * ratio;
    do_line("zoom-at",
            {fmt::format("{}", std::pow(1.25, steps)), fmt::format("{}", place.x()), fmt::format("{}", place.y())});
  }
}

void Window::drag_to(const QPointF& place) {
  if (!is_dragged_ && (place - pressed_at_).manhattanLength() < drag_begins_px) return;
  is_dragged_ = true;
  const QPointF moved = place - std::exchange(dragged_to_, place);
  if (held_plane_ && viewer_.frame() != nullptr && *held_plane_ < viewer_.frame()->planes.size()) {
    const FramePoint way = viewer_.frame()->planes[*held_plane_].way;
    const double way_squared = way.x * way.x + way.y * way.y, along = moved.x() * way.x + moved.y() * way.y;
    if (way_squared < 1) return;  // it is seen from the front
    return do_line("slice-move",
                   {fmt::format("{}", *held_plane_), fmt::format("{:.6f}", std::clamp(along / way_squared, -1., 1.))});
  }
  const bool orbits = !pans_ && turns_around(viewer_);
  const double scale = orbits ? degrees_a_pixel : 1;
  do_line(orbits ? "orbit" : "pan",
          {fmt::format("{}", (orbits ? -1 : 1) * scale * moved.x()), fmt::format("{}", scale * moved.y())});
}

void Window::moveEvent(QMoveEvent* event) {
  QMainWindow::moveEvent(event);
  refresh();
}

void Window::dragEnterEvent(QDragEnterEvent* event) {
  if (event->mimeData()->hasUrls()) event->acceptProposedAction();
}

void Window::dropEvent(QDropEvent* event) {
  Words files;
  for (const QUrl& url : event->mimeData()->urls())
    if (url.isLocalFile()) files.push_back(url.toLocalFile().toStdString());
  if (!files.empty() && files.size() <= 2) do_line("open", files);
}

bool Window::may_close() {
  const Session& session = viewer_.session();
  if (!options_.with_dialogs || !session.has_unsaved_work) return true;
  is_asking_ = true;
  QMessageBox box(QMessageBox::Question, "Wheatstone", "Your changes are not saved in a file yet.",
                  QMessageBox::Save | QMessageBox::Discard | QMessageBox::Cancel, this);
  box.setInformativeText("Save it before the window closes?");
  const int answer = box.exec();
  is_asking_ = false;
  if (answer == QMessageBox::Discard) return true;
  if (answer != QMessageBox::Save) return false;
  const bool is_path = !session.camera_path.keys.empty();
  const auto* const content = std::get_if<PaintedContent>(&session.opened.content);
  const bool has_painting = content != nullptr && content->painting;
  const Command& save = find_command(is_path ? "save-camera" : has_painting ? "save-painting" : "save-style");
  const std::optional<Words> file = ask_for_arguments(save);
  if (!file) return false;
  do_command(save, *file);
  return !session.message_is_error;  // what is being written is written to its end
}

void Window::closeEvent(QCloseEvent* event) {
  if (is_asking_ || !may_close()) {
    viewer_.session().ends = false;
    event->ignore();
    return;
  }
  viewer_.session().ends = true;
  event->accept();
}

void Window::save_screenshot(const std::filesystem::path& path) {
  refresh();
  // What has just been shown is laid out by its events; the script is not to go on within them.
  script_timer_.stop();
  QCoreApplication::processEvents(QEventLoop::ExcludeUserInputEvents);
  if (script_) script_timer_.start();
  write_image(path, image_of(grab().toImage()));
  heartbeat_.forgive();
}

ScriptHost Window::script_host() {
  return {.show = [this] { refresh(); },
          .screenshot = [this](const std::filesystem::path& path) { save_screenshot(path); },
          .resize = [this](int width, int height) { resize(width, height); },
          .print =
              [](const std::string& line) {
                fmt::print("{}\n", line);
                std::fflush(stdout);
              },
          .measured = [this] { return measured(); }};
}

std::vector<std::pair<std::string, double>> Window::measured() {
  const QWidget& picture = *surface_->widget();
  const double ratio = picture.devicePixelRatioF();
  const QPoint place = picture.mapToGlobal(QPoint(0, 0));
  const Blocked blocked = heartbeat_.take_worst();
  return {{"worst_gap_ms", blocked.gap_ms},
          {"worst_busy_ms", blocked.busy_ms},
          {"opengl", surface_->uses_opengl() ? 1 : 0},
          {"screen_x", place.x() * ratio},
          {"screen_y", place.y() * ratio},
          {"width", picture.width() * ratio},
          {"height", picture.height() * ratio}};
}

void Window::listen(std::unique_ptr<Control> control) {
  control_ = std::make_unique<ControlLink>(std::move(control), viewer_, [this] { refresh(); });
  heartbeat_.start();
}

void Window::end(int exit_code) {
  exit_code_ = exit_code;
  options_.with_dialogs = false;
  viewer_.session().ends = true;
  QApplication::closeAllWindows();
  QApplication::quit();
}

void Window::run(std::unique_ptr<Script> script) {
  script_ = std::move(script);
  script_timer_.start();
  heartbeat_.start();
}

void Window::go_on_with_script() {
  refresh();
  try {
    if (!script_->go_on(viewer_)) return;
  } catch (const Error& error) {
    // The command that started the window tells of signals.
    if (error.kind() != ErrorKind::interrupted) fmt::print(stderr, "wheatstone: {}\n", error.what());
    exit_code_ = static_cast<int>(error.kind());
  }
  script_timer_.stop();
  viewer_.session().ends = true;
  close();
}

}  // namespace wheatstone::viewer
