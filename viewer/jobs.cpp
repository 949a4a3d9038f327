#include "jobs.h"

#include <utility>

namespace wheatstone::viewer {

NewestJob::NewestJob() : thread_([this](const std::stop_token& ends) { work(ends); }) {}

NewestJob::~NewestJob() {
  thread_.request_stop();
  stop();
}

void NewestJob::start(Job job) {
  const std::lock_guard lock(mutex_);
  running_.request_stop();
  waiting_ = std::move(job);
  changed_.notify_all();
}

void NewestJob::stop() {
  const std::lock_guard lock(mutex_);
  running_.request_stop();
  waiting_ = nullptr;
}

bool NewestJob::is_busy() const {
  const std::lock_guard lock(mutex_);
  return is_working_ || waiting_;
}

void NewestJob::work(const std::stop_token& ends) {
  std::unique_lock lock(mutex_);
  while (changed_.wait(lock, ends, [this] { return static_cast<bool>(waiting_); })) {
    const Job job = std::exchange(waiting_, nullptr);
    running_ = std::stop_source();
    is_working_ = true;
    const std::stop_token stop = running_.get_token();
    lock.unlock();
    job(stop);
    lock.lock();
    is_working_ = false;
  }
}

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

void OrderedJobs::finish(std::chrono::milliseconds most) {
  std::unique_lock lock(mutex_);
  changed_.wait_for(lock, most, [this] { return jobs_.empty(); });
}

bool OrderedJobs::is_busy() const {
  const std::lock_guard lock(mutex_);
  return !jobs_.empty();
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
