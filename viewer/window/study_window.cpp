#include "study_window.h"

#include <fmt/format.h>

#include <QApplication>
#include <QKeyEvent>
#include <QLabel>
#include <QMouseEvent>
#include <QOpenGLWidget>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <exception>

#include "cli/failure.h"
#include "cli/print_facts.h"
#include "viewer/compose.h"
#include "wheatstone/error.h"

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
    fmt::print(stderr, "wheatstone: the session was broken off; run it again to go on\n");
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

}  // namespace wheatstone::viewer
