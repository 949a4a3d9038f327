#pragma once

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
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

}  // namespace wheatstone::viewer
