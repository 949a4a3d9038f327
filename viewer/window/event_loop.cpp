#include "event_loop.h"

#include <QLocale>
#include <QMetaObject>
#include <algorithm>
#include <clocale>
#include <ctime>
#include <utility>

#include "cli/interrupt.h"

namespace wheatstone::viewer {
namespace {

constexpr int step_ms = 3;

constexpr int beat_ms = 5;

double thread_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

void use_plain_numbers() {
  QLocale::setDefault(QLocale::c());
  std::setlocale(LC_NUMERIC, "C");
}

EndSignals::EndSignals(std::function<void()> told) : told_(std::move(told)) {
  cli::on_signal([this] {
    QMetaObject::invokeMethod(
        this, [this] { told_(); }, Qt::QueuedConnection);
  });
}

EndSignals::~EndSignals() { cli::on_signal({}); }

ControlLink::ControlLink(std::unique_ptr<Control> control, Viewer& viewer, std::function<void()> refresh)
    : control_(std::move(control)),
      viewer_(viewer),
      refresh_(std::move(refresh)),
      notifier_(control_->descriptor(), QSocketNotifier::Read) {
  timer_.setSingleShot(true);
  connect(&notifier_, &QSocketNotifier::activated, this, [this] { go_on(); });
  connect(&timer_, &QTimer::timeout, this, [this] { go_on(); });
}

void ControlLink::go_on() {
  // A dialog's own event loop, in which this is called again, may lie below.
  const bool is_nested = !notifier_.isEnabled();
  if (is_nested) return;
  notifier_.setEnabled(false);
  control_->go_on(viewer_);
  refresh_();
  notifier_.setEnabled(true);
  if (control_->is_waiting()) timer_.start(step_ms);
}

void Heartbeat::start() {
  timer_.setTimerType(Qt::PreciseTimer);
  QObject::connect(&timer_, &QTimer::timeout, &timer_, [this] {
    const double gap_ms = static_cast<double>(since_beat_.nsecsElapsed()) / 1e6 - beat_ms;
    worst_.gap_ms = std::max(worst_.gap_ms, gap_ms);
    worst_.busy_ms = std::max(worst_.busy_ms, thread_time_ms() - busy_before_ms_);
    forgive();
  });
  forgive();
  timer_.start(beat_ms);
}

Blocked Heartbeat::take_worst() { return std::exchange(worst_, {}); }

void Heartbeat::forgive() {
  since_beat_.start();
  busy_before_ms_ = thread_time_ms();
}

}  // namespace wheatstone::viewer
