#include "ordered_jobs.h"

#include <utility>

namespace wheatstone::viewer {

OrderedJobs::OrderedJobs() : thread_([this](const std::stop_token& ends) { work(ends); }) {}

void OrderedJobs::start(std::function<void()> job) {
  const std::lock_guard lock(mutex_);
  jobs_.push_back(std::move(job));
  changed_.notify_all();
}

void OrderedJobs::finish() {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [this] { return jobs_.empty(); });
}

void OrderedJobs::work(const std::stop_token& ends) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, ends, [this] { return !jobs_.empty(); })) {
    const std::function<void()> job = std::move(jobs_.front());
    lock.unlock();
    job();
    lock.lock();
    jobs_.pop_front();
    changed_.notify_all();
  }
}

}  // namespace wheatstone::viewer
