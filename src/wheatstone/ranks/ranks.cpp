#include "wheatstone/ranks/ranks.h"

#include <algorithm>
#include <new>
#include <optional>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/ranks/transport_internal.h"

namespace wheatstone {
namespace {

/// Instead of a number of bytes: the rank that gives it has failed.
constexpr std::uint64_t failed = ~std::uint64_t{0};

Ranks::Bytes message_of(const Ranks::Failure& failure) {
  Ranks::Bytes bytes = Ranks::bytes_of(std::span<const int>(&failure.exit_code, 1));
  const Ranks::Bytes text = Ranks::bytes_of(std::span<const char>(failure.message));
  bytes.insert(bytes.end(), text.begin(), text.end());
  return bytes;
}

Ranks::Failure failure_in(const Ranks::Bytes& message) {
  Ranks::Failure failure{};
  std::memcpy(&failure.exit_code, message.data(), sizeof(int));
  failure.message.assign(reinterpret_cast<const char*>(message.data()) + sizeof(int), message.size() - sizeof(int));
  return failure;
}

}  // namespace

struct Ranks::State {
  std::shared_ptr<Transport> transport;
  std::optional<Failure> failure;  ///< what all ranks end with, once one has failed

  /// The failure of the first of the ranks that have failed: it tells all. `mine` is this rank's, where it has failed.
  const Failure& learn(const std::vector<std::uint64_t>& sizes, const Failure* mine) {
    const auto count = sizes.size();
    const auto teller = static_cast<std::size_t>(std::ranges::find(sizes, failed) - sizes.begin());
    std::vector<Bytes> to(count), from(count);
    std::vector<std::uint64_t> to_sizes(count, 0), from_sizes(count);
    if (mine != nullptr && static_cast<int>(teller) == transport->rank()) to.assign(count, message_of(*mine));
    std::ranges::transform(to, to_sizes.begin(), &Bytes::size);
    transport->swap_numbers(to_sizes, from_sizes);
    for (std::size_t i = 0; i < count; ++i) from[i].resize(from_sizes[i]);
    transport->swap_bytes(to, from);
    failure = failure_in(from[teller]);
    return *failure;
  }
};

Ranks::Ranks(std::shared_ptr<Transport> transport)
    : state_(std::make_shared<State>(State{.transport = std::move(transport), .failure = {}})) {}

int Ranks::rank() const { return state_ ? state_->transport->rank() : 0; }
int Ranks::count() const { return state_ ? state_->transport->count() : 1; }

std::vector<std::uint64_t> Ranks::swap_sizes(const std::vector<std::uint64_t>& sizes) const {
  std::vector<std::uint64_t> from(sizes.size());
  state_->transport->swap_numbers(sizes, from);
  if (std::ranges::find(from, failed) == from.end()) return from;
  const Failure& failure = state_->learn(from, nullptr);
  throw Error(static_cast<ErrorKind>(failure.exit_code), failure.message);
}

void Ranks::meet() const {
  if (!alone()) swap_sizes(std::vector<std::uint64_t>(static_cast<std::size_t>(count()), 0));
}

std::vector<Ranks::Bytes> Ranks::exchange(const std::vector<Bytes>& to_each) const {
  if (alone()) return to_each;
  std::vector<std::uint64_t> sizes(to_each.size());
  std::ranges::transform(to_each, sizes.begin(), &Bytes::size);
  const std::vector<std::uint64_t> from_sizes = swap_sizes(sizes);
  std::vector<Bytes> from(from_sizes.size());
  try {
    for (std::size_t i = 0; i < from.size(); ++i) from[i].resize(from_sizes[i]);
    state_->transport->swap_bytes(to_each, from);
  } catch (const std::bad_alloc&) {
    // The others are about to send.
    state_->transport->abort(static_cast<int>(ErrorKind::cannot_read_write));
  }
  return from;
}

std::vector<Ranks::Bytes> Ranks::from_all(const Bytes& mine) const {
  return exchange(std::vector<Bytes>(static_cast<std::size_t>(count()), mine));
}

std::vector<Ranks::Bytes> Ranks::to_first(const Bytes& mine) const {
  std::vector<Bytes> to(static_cast<std::size_t>(count()));
  to.front() = mine;
  return exchange(to);
}

Ranks::Bytes Ranks::from_first(const Bytes& mine) const {
  return exchange(std::vector<Bytes>(static_cast<std::size_t>(count()), first() ? mine : Bytes())).front();
}

Ranks::Failure Ranks::fail(const Failure& failure) const {
  // What was learned from the others they know.
  if (alone() || state_->failure) return failure;
  const std::vector<std::uint64_t> sizes(static_cast<std::size_t>(count()), failed);
  std::vector<std::uint64_t> from(sizes.size());
  state_->transport->swap_numbers(sizes, from);
  return state_->learn(from, &failure);
}

bool anywhere(bool here, const Ranks& ranks) {
  return std::ranges::count(ranks.from_all(static_cast<char>(here)), 1) > 0;
}

RankPart part_of(const Ranks& ranks, std::size_t count) {
  const auto all = static_cast<std::size_t>(ranks.count());
  const auto rank = static_cast<std::size_t>(ranks.rank());
  return {count * rank / all, count * (rank + 1) / all};
}

}  // namespace wheatstone
