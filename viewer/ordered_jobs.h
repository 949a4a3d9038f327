#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace wheatstone::viewer {

/// A thread that does all jobs that it is given, one after the other. Destroyed, it does the rest first.
class OrderedJobs {
 public:
  OrderedJobs();
  ~OrderedJobs() { finish(); }
  OrderedJobs(const OrderedJobs&) = delete;
  OrderedJobs& operator=(const OrderedJobs&) = delete;

  /// The job may not throw.
  void start(std::function<void()> job);
  /// Returns when all are done.
  void finish();

 private:
  void work(const std::stop_token& ends);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::function<void()>> jobs_;  ///< the first is being done
  std::jthread thread_;                     ///< last: it ends first
};

}  // namespace wheatstone::viewer
