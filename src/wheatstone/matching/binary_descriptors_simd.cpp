#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "wheatstone/matching/binary_descriptors_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/matching/binary_descriptors_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Words = hn::CappedTag<std::uint64_t, BinaryDescriptors::widest_vector>;

/// How many bits of some descriptors, from number `i` on, differ from those of one.
HWY_INLINE hn::Vec<Words> differing_bits(const BinaryDescriptors& among, int i,
                                         const std::array<std::uint64_t, BinaryDescriptors::words>& to) {
  const Words d;
  const auto differing = [&](std::size_t word) {
    return hn::Xor(hn::LoadU(d, among.word[word].data() + i), hn::Set(d, to[word]));
  };
#if HWY_TARGET == HWY_SCALAR
  auto sum = hn::Zero(d);
  for (std::size_t word = 0; word < to.size(); ++word) sum = hn::Add(sum, hn::PopulationCount(differing(word)));
  return sum;
#else
  const hn::Repartition<std::uint8_t, Words> bytes;
  auto sums = hn::Zero(bytes);  // at most eight bits a word
  for (std::size_t word = 0; word < to.size(); ++word)
    sums = hn::Add(sums, hn::PopulationCount(hn::BitCast(bytes, differing(word))));
  return hn::SumsOf8(sums);
#endif
}

/// The nearest of some descriptors. It has the least key: the bits that differ, and below them its number.
NearestBinary find_nearest_binary(const BinaryDescriptors& among,
                                  const std::array<std::uint64_t, BinaryDescriptors::words>& to) {
  const Words d;
  const hn::RebindToSigned<Words> keys;
  const auto lanes = static_cast<int>(hn::Lanes(d));
  auto least = hn::Set(keys, std::int64_t{0x7FFFFFFFFFFFFFFF});
  auto numbers = hn::Iota(d, 0);
  for (int i = 0; i < among.count; i += lanes) {
    const auto key = hn::Or(hn::ShiftLeft<32>(differing_bits(among, i, to)), numbers);
    least = hn::Min(least, hn::BitCast(keys, key));
    numbers = hn::Add(numbers, hn::Set(d, static_cast<std::uint64_t>(lanes)));
  }
  std::array<std::int64_t, BinaryDescriptors::widest_vector> each{};
  hn::StoreU(least, keys, each.data());
  const std::int64_t key = *std::min_element(each.begin(), each.begin() + lanes);
  // What stands after the end is never nearer than what it repeats.
  return {static_cast<int>(key & 0xFFFFFFFF), static_cast<int>(key >> 32)};
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {
namespace {

HWY_EXPORT(find_nearest_binary);

using OneDescriptor = std::array<std::uint64_t, BinaryDescriptors::words>;

OneDescriptor words_of(const cv::Mat& descriptors, int row) {
  OneDescriptor words{};
  std::memcpy(words.data(), descriptors.ptr(row), sizeof words);
  return words;
}

BinaryDescriptors word_by_word(const cv::Mat& descriptors) {
  BinaryDescriptors result{descriptors.rows, {}};
  for (int row = 0; row < descriptors.rows + BinaryDescriptors::widest_vector; ++row) {
    const OneDescriptor words = words_of(descriptors, std::min(row, descriptors.rows - 1));
    for (std::size_t i = 0; i < words.size(); ++i) result.word[i].push_back(words[i]);
  }
  return result;
}

/// The nearest row of `among` to each of `to`.
std::vector<NearestBinary> nearest_rows(const cv::Mat& to, const cv::Mat& among) {
  const BinaryDescriptors descriptors = word_by_word(among);
  std::vector<NearestBinary> nearest(static_cast<std::size_t>(to.rows));
  constexpr int rows_at_once = 64;
  tbb::parallel_for(tbb::blocked_range<int>(0, to.rows, rows_at_once), [&](const tbb::blocked_range<int>& rows) {
    for (int row = rows.begin(); row < rows.end(); ++row)
      nearest[static_cast<std::size_t>(row)] =
          HWY_DYNAMIC_DISPATCH(find_nearest_binary)(descriptors, words_of(to, row));
  });
  return nearest;
}

}  // namespace

std::vector<BinaryMatch> match_binary_descriptors(const cv::Mat& left, const cv::Mat& right) {
  std::vector<BinaryMatch> matches;
  if (left.empty() || right.empty()) return matches;
  CV_Assert(left.cols == sizeof(OneDescriptor) && right.cols == sizeof(OneDescriptor));
  const std::vector<NearestBinary> of_left = nearest_rows(left, right), of_right = nearest_rows(right, left);
  for (int row = 0; row < left.rows; ++row) {
    const NearestBinary& nearest = of_left[static_cast<std::size_t>(row)];
    if (of_right[static_cast<std::size_t>(nearest.row)].row == row)
      matches.push_back({row, nearest.row, nearest.distance_bits});
  }
  return matches;
}

}  // namespace wheatstone
#endif  // HWY_ONCE
