#pragma once

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>
#include <utility>
#include <vector>

namespace wheatstone::viewer {

/// What other threads want done on the thread that owns the session.
class Mailbox {
 public:
  /// `wake` is called, on the thread that posts, with every post.
  explicit Mailbox(std::function<void()> wake) : wake_(std::move(wake)) {}

  void post(std::function<void()> letter) {
    {
      const std::lock_guard lock(mutex_);
      letters_.push_back(std::move(letter));
    }
    arrived_.notify_all();
    if (wake_) wake_();
  }

  /// Does all that was posted, in order.
  void open() {
    std::vector<std::function<void()>> letters;
    {
      const std::lock_guard lock(mutex_);
      letters.swap(letters_);
    }
    for (const std::function<void()>& letter : letters) letter();
  }

  bool is_empty() const {
    const std::lock_guard lock(mutex_);
    return letters_.empty();
  }

  /// Returns when there is something to open, or after so long.
  void wait_for(std::chrono::milliseconds longest) {
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, longest, [this] { return !letters_.empty(); });
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<std::function<void()>> letters_;
  std::function<void()> wake_;
};

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
  /// Returns when all are done, or after `most`.
  void finish(std::chrono::milliseconds most);
  bool is_busy() const;

 private:
  void work(const std::stop_token& ends);

  mutable std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<std::function<void()>> jobs_;  ///< the first is being done
  std::jthread thread_;                     ///< last: it ends first
};

}  // namespace wheatstone::viewer
