#include "heartbeat.h"

#include <algorithm>
#include <ctime>
#include <utility>

namespace wheatstone::viewer {
namespace {

constexpr int beat_ms = 5;

double thread_time_ms() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
}

}  // namespace

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
