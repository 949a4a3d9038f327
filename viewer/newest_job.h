#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace wheatstone::viewer {

/// A thread that works on the newest of the jobs that it is given. A newer job replaces one that waits, and asks one
/// that is being done to stop. Destroyed, it asks the job to stop and waits for it.
class NewestJob {
 public:
  using Job = std::function<void(const std::stop_token&)>;

  NewestJob();
  ~NewestJob();
  NewestJob(const NewestJob&) = delete;
  NewestJob& operator=(const NewestJob&) = delete;

  void start(Job job);
  /// Asks the job to stop, and forgets one that waits.
  void stop();
  /// A job is being done, or waits.
  bool is_busy() const;

 private:
  void work(const std::stop_token& ends);

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  Job waiting_;
  std::stop_source running_;
  bool is_working_ = false;
  std::jthread thread_;  ///< last: it ends first
};

}  // namespace wheatstone::viewer
