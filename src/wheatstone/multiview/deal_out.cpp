#include "wheatstone/multiview/deal_out_internal.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace wheatstone {
namespace {

/// Bytes as they are put together.
template <class Value>
void put(std::span<const Value> values, Ranks::Bytes& to) {
  const auto bytes = std::as_bytes(values);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

/// Takes as many values as there is place for.
template <class Value>
void take(std::span<const std::byte>& from, std::span<Value> values) {
  if (!values.empty()) std::memcpy(values.data(), from.data(), values.size_bytes());
  from = from.subspan(values.size_bytes());
}

template <class Value>
Value take_one(std::span<const std::byte>& from) {
  Value value{};
  take(from, std::span(&value, 1));
  return value;
}

/// Bins that follow each other: those of one band.
struct BinRun {
  std::size_t first, count;
};

std::size_t bins_of(const SplatOrders& orders) { return orders.back().first_bin + orders.back().bins(); }

/// The bins of each rank's bands, in order.
std::vector<std::vector<BinRun>> bins_by_rank(const SplatOrders& orders, const Ranks& ranks) {
  std::vector<std::vector<BinRun>> runs(static_cast<std::size_t>(ranks.count()));
  for (const SplatOrder& order : orders)
    for (int band = 0; band < order.bands; ++band)
      runs[static_cast<std::size_t>(order.owner(band))].push_back(
          {order.bin(band, 0), static_cast<std::size_t>(order.parts)});
  return runs;
}

void put_block(const SplatBlock& block, const std::vector<BinRun>& runs, Ranks::Bytes& to) {
  std::vector<std::uint32_t> counts;
  for (const BinRun& run : runs)
    for (std::size_t bin = run.first; bin < run.first + run.count; ++bin)
      counts.push_back(block.begin[bin + 1] - block.begin[bin]);
  put(std::span<const std::uint32_t>(counts), to);
  for (const BinRun& run : runs) {
    const std::uint32_t first = block.begin[run.first];
    put(std::span<const Splat>(block.splats).subspan(first, block.begin[run.first + run.count] - first), to);
  }
}

/// How long what follows becomes.
std::size_t bytes_for(const std::vector<std::vector<SplatBlock>>& blocks, const std::vector<BinRun>& runs) {
  std::size_t bytes = 0;
  for (const std::vector<SplatBlock>& some : blocks) {
    bytes += sizeof(std::uint64_t);
    for (const SplatBlock& block : some)
      for (const BinRun& run : runs)
        bytes += run.count * sizeof(std::uint32_t) +
                 (block.begin[run.first + run.count] - block.begin[run.first]) * sizeof(Splat);
  }
  return bytes;
}

SplatBlock take_block(std::span<const std::byte>& from, const std::vector<BinRun>& runs, std::size_t bins) {
  SplatBlock block;
  // Counts first; then where each bin begins.
  block.begin.assign(bins + 1, 0);
  for (const BinRun& run : runs) take(from, std::span(block.begin).subspan(run.first, run.count));
  std::uint32_t total = 0;
  for (std::uint32_t& begin : block.begin) begin = std::exchange(total, total + begin);
  block.splats.resize(total);
  take(from, std::span(block.splats));
  return block;
}

template <class Row>
void for_each_row(const SplatOrder& order, std::span<const ViewTarget> targets, int owner, Row row) {
  for (int band = 0; band < order.bands; ++band) {
    if (order.owner(band) != owner) continue;
    for (const ViewTarget& target : targets) {
      const int end = std::min((band + 1) * order.band_rows, target.height());
      for (int y = band * order.band_rows; y < end; ++y) {
        if (target.light != nullptr) {
          row(target.light->whole_row(y));
        } else {
          row(target.picture.row(y));
        }
      }
    }
  }
}

}  // namespace

// Memory is released as soon as its contents are packed, sent or unpacked, so that a rank holds its chunk about twice.
std::vector<std::vector<SplatBlock>> deal_out(std::vector<std::vector<SplatBlock>> blocks, const SplatOrders& orders,
                                              const Ranks& ranks) {
  const std::vector<std::vector<BinRun>> runs = bins_by_rank(orders, ranks);
  std::vector<Ranks::Bytes> to(runs.size());
  tbb::parallel_for(std::size_t{0}, runs.size(), [&](std::size_t rank) {
    to[rank].reserve(bytes_for(blocks, runs[rank]));
    for (const std::vector<SplatBlock>& some : blocks) {
      const std::uint64_t count = some.size();
      put(std::span(&count, 1), to[rank]);
      for (const SplatBlock& block : some) put_block(block, runs[rank], to[rank]);
    }
  });
  blocks = {};
  std::vector<Ranks::Bytes> from = ranks.exchange(to);
  to = {};

  const std::vector<BinRun>& mine = runs[static_cast<std::size_t>(ranks.rank())];
  std::vector<std::vector<std::vector<SplatBlock>>> by_rank(from.size());
  tbb::parallel_for(std::size_t{0}, from.size(), [&](std::size_t rank) {
    std::span<const std::byte> rest = from[rank];
    while (!rest.empty()) {
      const auto count = take_one<std::uint64_t>(rest);
      std::generate_n(std::back_inserter(by_rank[rank].emplace_back()), count,
                      [&] { return take_block(rest, mine, bins_of(orders)); });
    }
    from[rank] = {};
  });
  std::vector<std::vector<SplatBlock>> taken;
  for (auto& of_rank : by_rank) std::ranges::move(of_rank, std::back_inserter(taken));
  return taken;
}

void share_bands(const SplatOrder& order, std::span<const ViewTarget> targets, bool to_all, const Ranks& ranks) {
  if (ranks.alone()) return;
  Ranks::Bytes mine;
  for_each_row(order, targets, ranks.rank(),
               [&](auto row) { put(std::span<const typename decltype(row)::value_type>(row), mine); });
  const std::vector<Ranks::Bytes> all = to_all ? ranks.from_all(mine) : ranks.to_first(mine);
  for (int rank = 0; rank < ranks.count(); ++rank) {
    std::span<const std::byte> rest = all[static_cast<std::size_t>(rank)];
    if (rank != ranks.rank() && !rest.empty()) for_each_row(order, targets, rank, [&](auto row) { take(rest, row); });
  }
}

}  // namespace wheatstone
