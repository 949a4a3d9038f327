#pragma once

#include <barrier>
#include <cstdlib>
#include <exception>
#include <functional>
#include <memory>
#include <thread>
#include <vector>

#include "wheatstone/error.h"
#include "wheatstone/ranks/ranks.h"
#include "wheatstone/ranks/transport_internal.h"

namespace wheatstone {

/// What ranks that are threads of one process leave for each other.
struct ThreadMail {
  explicit ThreadMail(int count) : all(count), numbers(count), bytes(count) {}
  std::barrier<> all;
  std::vector<std::vector<std::uint64_t>> numbers;         // [from][to]
  std::vector<std::vector<std::vector<std::byte>>> bytes;  // [from][to]
};

class ThreadTransport : public Transport {
 public:
  ThreadTransport(std::shared_ptr<ThreadMail> mail, int rank) : mail_(std::move(mail)), rank_(rank) {}
  int rank() const override { return rank_; }
  int count() const override { return static_cast<int>(mail_->numbers.size()); }
  void swap_numbers(std::span<const std::uint64_t> to, std::span<std::uint64_t> from) override {
    mail_->numbers[rank_].assign(to.begin(), to.end());
    mail_->all.arrive_and_wait();
    for (int other = 0; other < count(); ++other) from[other] = mail_->numbers[other][rank_];
    mail_->all.arrive_and_wait();
  }
  void swap_bytes(std::span<const std::vector<std::byte>> to, std::span<std::vector<std::byte>> from) override {
    mail_->bytes[rank_].assign(to.begin(), to.end());
    mail_->all.arrive_and_wait();
    for (int other = 0; other < count(); ++other) from[other] = mail_->bytes[other][rank_];
    mail_->all.arrive_and_wait();
  }
  [[noreturn]] void abort(int exit_code) override { std::exit(exit_code); }

 private:
  std::shared_ptr<ThreadMail> mail_;
  int rank_;
};

/// Calls `work` as so many ranks at once. Throws what the ranks end with, where one of them fails.
inline void as_ranks(int count, const std::function<void(const Ranks& ranks)>& work) {
  const auto mail = std::make_shared<ThreadMail>(count);
  std::vector<std::exception_ptr> errors(count);
  std::vector<std::thread> threads;
  for (int rank = 0; rank < count; ++rank)
    threads.emplace_back([&, rank] {
      const Ranks ranks(std::make_shared<ThreadTransport>(mail, rank));
      try {
        work(ranks);
        ranks.meet();
      } catch (const Error& error) {
        const Ranks::Failure failure = ranks.fail({static_cast<int>(error.kind()), error.what()});
        errors[rank] = std::make_exception_ptr(Error(static_cast<ErrorKind>(failure.exit_code), failure.message));
      }
    });
  for (std::thread& thread : threads) thread.join();
  if (errors.front()) std::rethrow_exception(errors.front());
}

}  // namespace wheatstone
