#include "calls.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <list>
#include <thread>

#include "wheatstone/error.h"
#include "wheatstone/files/unfinished_outputs.h"

namespace wheatstone::python {
namespace {

namespace py = pybind11;
using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

constexpr auto patience = 150ms;  ///< for work to end itself
constexpr auto glance = 20ms;     ///< between two looks at Python's signals

/// The calls of this process, and the threads of Python that wait for them. Never destroyed: work may go on when the
/// process ends.
struct Calls {
  std::mutex mutex;
  std::list<std::weak_ptr<Call>> all;
  bool interpreter_exits = false;
  int taking_lock = 0;  ///< threads that have waited and take the interpreter's lock again
};

Calls& calls() {
  static auto* const those = new Calls;
  return *those;
}

/// Without the interpreter's lock. A thread of Python that took it while the interpreter exits would be ended by it,
/// and the process with the thread: it stays here instead.
class WithoutLock {
 public:
  WithoutLock() : state_(PyEval_SaveThread()) {}
  ~WithoutLock() {
    {
      std::unique_lock lock(calls().mutex);
      while (calls().interpreter_exits && !exiting_thread) {
        lock.unlock();
        ::pause();
        lock.lock();
      }
      ++calls().taking_lock;
    }
    PyEval_RestoreThread(state_);
    const std::scoped_lock lock(calls().mutex);
    --calls().taking_lock;
  }
  WithoutLock(const WithoutLock&) = delete;
  WithoutLock& operator=(const WithoutLock&) = delete;

  static thread_local bool exiting_thread;  ///< the one in which the interpreter exits

 private:
  PyThreadState* state_;
};
thread_local bool WithoutLock::exiting_thread = false;

std::list<std::shared_ptr<Call>> living_calls() {
  std::list<std::shared_ptr<Call>> living;
  const std::scoped_lock lock(calls().mutex);
  calls().all.remove_if([](const std::weak_ptr<Call>& call) { return call.expired(); });
  for (const std::weak_ptr<Call>& known : calls().all)
    if (auto call = known.lock(); call && !call->has_ended()) living.push_back(std::move(call));
  return living;
}

/// The process must end while work goes on, which destructors of the program's own variables would disturb.
void end_at_once(int code, void* /*none*/) {
  std::fflush(nullptr);
  ::_exit(code);
}

/// Removes what is half-written, and lets nobody write more.
void give_up_outputs() {
  [[maybe_unused]] static auto* const never_released = new auto(hold_outputs());
  remove_unfinished_outputs();
  // A file may have been opened by its name in the moment of its removal.
  std::this_thread::sleep_for(5ms);
  remove_unfinished_outputs();
}

void end_all_calls() {
  WithoutLock::exiting_thread = true;
  const WithoutLock unlocked;
  {
    const std::scoped_lock lock(calls().mutex);
    calls().interpreter_exits = true;
  }
  const auto living = living_calls();
  for (const auto& call : living) call->cancel();
  const auto must_wait = [&living] {
    const std::scoped_lock lock(calls().mutex);
    return calls().taking_lock > 0 || std::ranges::any_of(living, [](const auto& call) { return !call->has_ended(); });
  };
  const auto last = Clock::now() + patience;
  while (must_wait() && Clock::now() < last) std::this_thread::sleep_for(1ms);
  if (living_calls().empty()) return;
  ::on_exit(end_at_once, nullptr);
  give_up_outputs();
}

/// A child has none of the threads of its parent.
void forget_calls() { new (&calls()) Calls; }

}  // namespace

std::shared_ptr<Call> Call::start(Work work) {
  auto call = std::make_shared<Call>();
  {
    const std::scoped_lock lock(calls().mutex);
    calls().all.remove_if([](const std::weak_ptr<Call>& known) { return known.expired(); });
    calls().all.push_back(call);
  }
  std::thread([call, work = std::move(work)]() mutable {
    call->run(work);
    work = nullptr;
  }).detach();
  return call;
}

void Call::run(const Work& work) {
  std::exception_ptr failure;
  try {
    const OutputsOnlyWhile wanted([this] { return !cancelled_; });
    work([this](std::string_view step, double done) { report(step, done); });
  } catch (...) {
    failure = std::current_exception();
  }
  const std::scoped_lock lock(mutex_);
  failure_ = failure;
  ended_ = true;
  end_.notify_all();
}

void Call::report(std::string_view step, double done) {
  if (cancelled_) throw Error(ErrorKind::interrupted, "the call was cancelled");
  const std::scoped_lock lock(mutex_);
  step_ = step;
  done_ = done;
}

void Call::cancel() {
  const auto hold = hold_outputs();  // what is being finished is finished
  cancelled_ = true;
}

bool Call::wait(std::optional<double> seconds) {
  const auto begin = Clock::now();
  const auto limit = std::chrono::duration<double>(seconds.value_or(0));
  while (true) {
    {
      const WithoutLock unlocked;
      std::unique_lock lock(mutex_);
      if (end_.wait_for(lock, glance, [this] { return ended_; })) return true;
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (seconds && Clock::now() - begin >= limit) return false;
  }
}

std::exception_ptr Call::failure() const {
  const std::scoped_lock lock(mutex_);
  return failure_;
}

bool Call::has_ended() const {
  const std::scoped_lock lock(mutex_);
  return ended_;
}

std::string Call::step() const {
  const std::scoped_lock lock(mutex_);
  return step_;
}

double Call::done() const {
  const std::scoped_lock lock(mutex_);
  return done_;
}

void finish(Call& call) {
  try {
    call.wait();
  } catch (const py::error_already_set&) {
    const WithoutLock unlocked;
    call.cancel();
    const auto last = Clock::now() + patience;
    while (!call.has_ended() && Clock::now() < last) std::this_thread::sleep_for(1ms);
    throw;
  }
  if (const std::exception_ptr failure = call.failure()) std::rethrow_exception(failure);
}

void add_end_of_calls(py::module_& module) {
  module.def("end_all_calls", &end_all_calls);
  py::module_::import("atexit").attr("register")(module.attr("end_all_calls"));
  ::pthread_atfork(nullptr, nullptr, forget_calls);
}

}  // namespace wheatstone::python
