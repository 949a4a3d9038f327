#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "wheatstone/progress.h"

namespace wheatstone::python {

/// Work of the library in a thread of its own. That thread never takes the interpreter's lock, so that an interpreter
/// which exits does not wait for it, and what waits for the work can be left at any moment.
class Call {
 public:
  using Work = std::function<void(const Progress&)>;

  /// Begins. The work owns all that it uses, which are no objects of Python.
  static std::shared_ptr<Call> start(Work work);

  /// Asks the work to end at its next report. From then on it finishes no output.
  void cancel();
  /// Waits so many seconds at most, without the interpreter's lock; whether the work has ended. Throws
  /// pybind11::error_already_set where a signal of Python's raises, as Ctrl-C does.
  bool wait(std::optional<double> seconds = {});
  /// What ended the work, if it has failed.
  std::exception_ptr failure() const;
  bool has_ended() const;
  bool is_cancelled() const { return cancelled_; }
  std::string step() const;
  double done() const;

 private:
  void run(const Work& work);
  void report(std::string_view step, double done);

  mutable std::mutex mutex_;
  std::condition_variable end_;
  std::atomic<bool> cancelled_ = false;
  bool ended_ = false;
  std::exception_ptr failure_;
  std::string step_;
  double done_ = 0;
};

/// Waits for the work to end, and throws what it threw. Ctrl-C ends it; where it does not react soon, it is left to end
/// by itself, without a result.
void finish(Call& call);

/// What `make`, a function of a Progress, returns: the call of a function of Python's that may take long. `make` owns
/// all that it uses, which are no objects of Python.
template <class Make>
auto result_of(Make make) {
  using Result = std::invoke_result_t<Make&, const Progress&>;
  auto kept = std::make_shared<Make>(std::move(make));
  if constexpr (std::is_void_v<Result>) {
    finish(*Call::start([kept](const Progress& progress) { (*kept)(progress); }));
  } else {
    auto result = std::make_shared<std::optional<Result>>();
    finish(*Call::start([kept, result](const Progress& progress) { result->emplace((*kept)(progress)); }));
    return std::move(**result);
  }
}

/// Ends all work that is left when the interpreter exits; what does not react is not waited for.
void add_end_of_calls(pybind11::module_& module);

}  // namespace wheatstone::python
