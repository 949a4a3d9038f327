#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace wheatstone {

class Transport;

/// The processes that share one run, as this one of them sees the others; by default it is alone. A value: copies are
/// of the same processes.
///
/// Every function that takes or gives something is collective: all ranks call the same ones in the same order, from one
/// thread. A rank that fails calls `fail` instead of what comes next, and the others' calls throw its error: all end
/// with the same one.
class Ranks {
 public:
  using Bytes = std::vector<std::byte>;

  Ranks() = default;
  explicit Ranks(std::shared_ptr<Transport> transport);

  int rank() const;
  int count() const;
  bool alone() const { return count() == 1; }
  /// Whether this is the one that writes results and speaks to people.
  bool first() const { return rank() == 0; }

  /// Waits for all, and learns whether one failed.
  void meet() const;
  /// Gives bytes to each rank and takes what each gives to this one, both by rank.
  std::vector<Bytes> exchange(const std::vector<Bytes>& to_each) const;
  /// What each of the ranks has, by rank: everywhere, or at the first only, and nothing at the others.
  std::vector<Bytes> from_all(const Bytes& mine) const;
  std::vector<Bytes> to_first(const Bytes& mine) const;
  /// What the first has, at each.
  Bytes from_first(const Bytes& mine) const;
  /// The same of a plain value.
  template <class Value>
  std::vector<Value> from_all(const Value& mine) const {
    static_assert(std::is_trivially_copyable_v<Value>);
    std::vector<Value> all;
    for (const Bytes& bytes : from_all(bytes_of(std::span(&mine, 1))))
      std::memcpy(&all.emplace_back(), bytes.data(), sizeof(Value));
    return all;
  }

  /// What a rank ends with: an exit code and a message.
  struct Failure {
    int exit_code;
    std::string message;
  };
  /// Says to the others that this rank cannot go on; nothing where this rank has learned it from them. Gives what all
  /// end with: what the first of those says that failed.
  Failure fail(const Failure& failure) const;

  template <class Value>
  static Bytes bytes_of(std::span<const Value> values) {
    const auto bytes = std::as_bytes(values);
    return {bytes.begin(), bytes.end()};
  }

 private:
  struct State;
  std::vector<std::uint64_t> swap_sizes(const std::vector<std::uint64_t>& sizes) const;
  std::shared_ptr<State> state_;
};

/// Whether it is so at one of the ranks at least.
bool anywhere(bool here, const Ranks& ranks);

/// Which part of a list of so many belongs to this rank: parts of equal length, one after the other.
struct RankPart {
  std::size_t first, end;
};
RankPart part_of(const Ranks& ranks, std::size_t count);

}  // namespace wheatstone
