#include "interrupt.h"

#include <atomic>
#include <csignal>

#include "wheatstone/error.h"

namespace wheatstone::cli {
namespace {

std::atomic<bool> interrupted = false;
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait");

}  // namespace

void watch_signals() {
  struct sigaction once = {};
  once.sa_handler = [](int) { interrupted = true; };
  once.sa_flags = static_cast<int>(SA_RESETHAND) | SA_RESTART;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    // What was ignored stays so: a run under nohup outlives its terminal.
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &once, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
}

void throw_if_interrupted() {
  if (interrupted) throw Error(ErrorKind::interrupted, "interrupted; nothing half-written is left");
}

}  // namespace wheatstone::cli
