#include "interrupt.h"

#include <fmt/format.h>
#include <semaphore.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <exception>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>
#include <utility>

#include "failure.h"
#include "report.h"
#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"

namespace wheatstone::cli {
namespace {

using namespace std::chrono_literals;

constexpr std::string_view message = "interrupted; nothing half-written is left";
constexpr auto patience = 400ms;  ///< for a run to end itself
constexpr int ending_signals[] = {SIGINT, SIGTERM, SIGHUP};

/// Who ends the run; the first to say so does.
enum class Ending { none, by_itself, from_outside };
std::atomic<Ending> ending = Ending::none;
std::atomic<bool> interrupted = false;
// Never destroyed: the thread that ends the program may come after the end of main.
std::function<std::string()>& what_is_kept() {
  static auto* const kept = new std::function<std::string()>;
  return *kept;
}
static_assert(std::atomic<bool>::is_always_lock_free, "a signal handler must not wait");
bool json_wanted = false;
bool tells_of_signals = true;
sem_t noted;

/// Who is told of a signal, and how long the run then has to end itself.
struct Listener {
  std::mutex mutex;
  std::function<void()> told;
  std::chrono::milliseconds patience = ::wheatstone::cli::patience;
};
// Never destroyed, as above.
Listener& listener() {
  static auto* const only = new Listener;
  return *only;
}

bool some_wait() {
  const std::lock_guard hold(listener().mutex);
  return static_cast<bool>(listener().told);
}

/// Without the streams, which may be held by the run that does not react.
void put(int descriptor, std::string_view text) {
  [[maybe_unused]] const auto written = ::write(descriptor, text.data(), text.size());
}

/// What the user is told of a run that another thread ends.
std::string last_words() {
  try {
    if (const std::string kept = what_is_kept() ? what_is_kept()() : std::string(); !kept.empty())
      return fmt::format("interrupted; {}", kept);
  } catch (const std::exception&) {
    return "interrupted";
  }
  return std::string(message);
}

/// Removes what is unfinished and ends the program from another thread than the run's.
[[noreturn]] void tell_and_end(const std::string& words, int code) {
  remove_unfinished_outputs();
  // A file may have been opened by its name in the moment of its removal.
  std::this_thread::sleep_for(5ms);
  remove_unfinished_outputs();
  if (code == static_cast<int>(ErrorKind::interrupted) && !tells_of_signals) ::_exit(code);
  if (::isatty(STDERR_FILENO) != 0) put(STDERR_FILENO, "\r\033[K");  // the progress bar
  put(STDERR_FILENO, fmt::format("wheatstone: {}\n", words));
  if (json_wanted)
    put(STDOUT_FILENO, json_text(nlohmann::ordered_json{{"error", words}, {"exit_code", code}}, 2) + "\n");
  ::_exit(code);
}

/// Ends the program unless the run has ended itself, or has finished its outputs and only says so.
void end_from_outside() {
  const bool waits = some_wait();
  const auto hold = hold_outputs();
  Ending none = Ending::none;
  // What a run that waits for something else has finished does not end it.
  if ((!waits && outputs_are_finished()) || !ending.compare_exchange_strong(none, Ending::from_outside)) return;
  tell_and_end(last_words(), static_cast<int>(ErrorKind::interrupted));
}

void end_of_uncaught() noexcept {
  Ranks::Failure failure = failure_of(std::current_exception());
  Ending none = Ending::none;
  if (!ending.compare_exchange_strong(none, Ending::from_outside))
    while (true) ::pause();
  tell_and_end(one_line(std::move(failure.message)), failure.exit_code);
}

std::chrono::milliseconds tell_listener() {
  const std::lock_guard hold(listener().mutex);
  if (listener().told) listener().told();
  return listener().patience;
}

void wait_for_signal() {
  while (::sem_wait(&noted) != 0 && errno == EINTR) continue;
  std::this_thread::sleep_for(tell_listener());
  while (ending == Ending::none) {
    end_from_outside();
    std::this_thread::sleep_for(50ms);
  }
}

void note(int) {
  const int error = errno;
  interrupted = true;
  ::sem_post(&noted);
  errno = error;
}

}  // namespace

void end_in_one_line(bool json) {
  json_wanted = json;
  std::set_terminate(end_of_uncaught);
}

void watch_signals(bool says_so) {
  tells_of_signals = says_so;
  ::sem_init(&noted, 0, 0);
  struct sigaction noting = {};
  noting.sa_handler = note;
  noting.sa_flags = SA_RESTART;
  for (const int signal : ending_signals) {
    // What was ignored stays so: a run under nohup outlives its terminal.
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler != SIG_IGN) sigaction(signal, &noting, nullptr);
  }
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);
  std::thread(wait_for_signal).detach();
}

void on_signal(std::function<void()> told, std::chrono::milliseconds most) {
  const std::lock_guard hold(listener().mutex);
  listener().told = std::move(told);
  listener().patience = most;
  if (interrupted && listener().told) listener().told();
}

void throw_if_interrupted() {
  if (interrupted) throw Error(ErrorKind::interrupted, std::string(message));
}

void throw_interrupted() { throw Error(ErrorKind::interrupted, last_words()); }

void tell_what_is_kept(std::function<std::string()> kept) {
  const auto hold = hold_outputs();
  what_is_kept() = std::move(kept);
}

void run_is_over(bool with_others) {
  Ending before = Ending::none;
  if (!ending.compare_exchange_strong(before, Ending::by_itself) && before == Ending::from_outside)
    while (true) ::pause();
  for (const int signal : ending_signals) {
    struct sigaction now = {};
    sigaction(signal, nullptr, &now);
    if (now.sa_handler == note) std::signal(signal, with_others ? SIG_IGN : SIG_DFL);
  }
}

}  // namespace wheatstone::cli
