#include "heartbeat.h"

#include <algorithm>
#include <utility>

namespace wheatstone::viewer {
namespace {

constexpr int beat_ms = 5;

}  // namespace

void Heartbeat::start() {
  timer_.setTimerType(Qt::PreciseTimer);
  QObject::connect(&timer_, &QTimer::timeout, &timer_, [this] {
    worst_gap_ms_ = std::max(worst_gap_ms_, static_cast<double>(since_beat_.nsecsElapsed()) / 1e6 - beat_ms);
    since_beat_.start();
  });
  since_beat_.start();
  timer_.start(beat_ms);
}

double Heartbeat::take_worst_gap_ms() { return std::exchange(worst_gap_ms_, 0); }

void Heartbeat::forgive() { since_beat_.start(); }

}  // namespace wheatstone::viewer
