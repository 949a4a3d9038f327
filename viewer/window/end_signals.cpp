#include "end_signals.h"

#include <sys/eventfd.h>
#include <unistd.h>

#include <csignal>
#include <cstdint>
#include <utility>

namespace wheatstone::viewer {
namespace {

/// What a signal's handler may write to. Nothing else is safe there.
int signalled = -1;

void on_signal(int /*number*/) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t count = write(signalled, &one, sizeof one);
}

int make_event() {
  signalled = eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  return signalled;
}

}  // namespace

EndSignals::EndSignals(std::function<void()> told) : notifier_(make_event(), QSocketNotifier::Read) {
  connect(&notifier_, &QSocketNotifier::activated, this, [told = std::move(told)] {
    std::uint64_t count = 0;
    if (read(signalled, &count, sizeof count) == sizeof count) told();
  });
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
}

EndSignals::~EndSignals() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  close(std::exchange(signalled, -1));
}

}  // namespace wheatstone::viewer
