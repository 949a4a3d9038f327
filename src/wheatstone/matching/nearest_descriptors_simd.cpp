#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "wheatstone/matching/nearest_descriptors_internal.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "wheatstone/matching/nearest_descriptors_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace wheatstone::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::CappedTag<float, DescriptorBlocks::side_by_side>;
using Sums = hn::Vec<Floats>;

float squared_length(const float* descriptor, int columns) {
  float sum = 0;
  for (int i = 0; i < columns; ++i) sum += descriptor[i] * descriptor[i];
  return sum;
}

/// Takes in `row`, which comes after all that are there.
void insert(NearestDescriptors& nearest, int row, float squared_distance) {
  int place = NearestDescriptors::count - 1;
  if (!(squared_distance < nearest.squared_distance[place])) return;
  for (; place > 0 && squared_distance < nearest.squared_distance[place - 1]; --place) {
    nearest.squared_distance[place] = nearest.squared_distance[place - 1];
    nearest.row[place] = nearest.row[place - 1];
  }
  nearest.squared_distance[place] = squared_distance;
  nearest.row[place] = row;
}

/// What several descriptors beside each other, the first being `row`, are to one.
HWY_INLINE void take_in(NearestDescriptors& nearest, int row, Sums squared_distances) {
  const Floats d;
  const auto limit = hn::Set(d, nearest.squared_distance.back());
  if (hn::AllFalse(d, hn::Lt(squared_distances, limit))) return;
  HWY_ALIGN std::array<float, DescriptorBlocks::side_by_side> each{};
  hn::Store(squared_distances, d, each.data());
  for (std::size_t i = 0; i < hn::Lanes(d); ++i) insert(nearest, row + static_cast<int>(i), each[i]);
}

void find_nearest_part(const cv::Mat& from, const DescriptorBlocks& into, std::span<NearestDescriptors> result) {
  constexpr int block = DescriptorBlocks::side_by_side, rows_at_once = 4;
  const Floats d;
  const int lanes = static_cast<int>(hn::Lanes(d)), columns = into.columns;
  std::vector<float> own_lengths(from.rows);
  for (int y = 0; y < from.rows; ++y) own_lengths[y] = squared_length(from.ptr<float>(y), columns);
  for (int first = 0; first < static_cast<int>(into.squared_lengths.size()); first += lanes) {
    const float* values =
        into.values.data() + static_cast<std::ptrdiff_t>(first / block) * block * columns + first % block;
    const auto lengths = hn::LoadU(d, into.squared_lengths.data() + first);
    for (int y = 0; y < from.rows; y += rows_at_once) {
      // The last rows are looked at more than once where there are fewer.
      const auto row = [&](int i) { return std::min(y + i, from.rows - 1); };
      const float *row0 = from.ptr<float>(y), *row1 = from.ptr<float>(row(1));
      const float *row2 = from.ptr<float>(row(2)), *row3 = from.ptr<float>(row(3));
      auto dot0 = hn::Zero(d), dot1 = hn::Zero(d), dot2 = hn::Zero(d), dot3 = hn::Zero(d);
      for (int i = 0; i < columns; ++i) {
        const auto value = hn::LoadU(d, values + static_cast<std::ptrdiff_t>(i) * block);
        dot0 = hn::MulAdd(value, hn::Set(d, row0[i]), dot0);
        dot1 = hn::MulAdd(value, hn::Set(d, row1[i]), dot1);
        dot2 = hn::MulAdd(value, hn::Set(d, row2[i]), dot2);
        dot3 = hn::MulAdd(value, hn::Set(d, row3[i]), dot3);
      }
      // |a − b|² = |a|² + |b|² − 2 a·b
      const auto squared_distance = [&](int i, Sums dot) {
        return hn::NegMulAdd(hn::Set(d, 2.f), dot, hn::Add(lengths, hn::Set(d, own_lengths[y + i])));
      };
      take_in(result[y], first, squared_distance(0, dot0));
      if (y + 1 < from.rows) take_in(result[y + 1], first, squared_distance(1, dot1));
      if (y + 2 < from.rows) take_in(result[y + 2], first, squared_distance(2, dot2));
      if (y + 3 < from.rows) take_in(result[y + 3], first, squared_distance(3, dot3));
    }
  }
}

}  // namespace wheatstone::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace wheatstone {
namespace {

HWY_EXPORT(find_nearest_part);

DescriptorBlocks in_blocks(const cv::Mat& descriptors) {
  constexpr int block = DescriptorBlocks::side_by_side;
  const int blocks = (descriptors.rows + block - 1) / block;
  DescriptorBlocks result{descriptors.cols, {}, {}};
  result.values.resize(static_cast<std::size_t>(blocks) * block * descriptors.cols);
  result.squared_lengths.resize(static_cast<std::size_t>(blocks) * block, NearestDescriptors::nowhere);
  for (int y = 0; y < descriptors.rows; ++y) {
    const auto* from = descriptors.ptr<float>(y);
    float* to = result.values.data() + static_cast<std::ptrdiff_t>(y / block) * block * descriptors.cols + y % block;
    for (int i = 0; i < descriptors.cols; ++i) to[static_cast<std::ptrdiff_t>(i) * block] = from[i];
    result.squared_lengths[y] = static_cast<float>(descriptors.row(y).dot(descriptors.row(y)));
  }
  return result;
}

}  // namespace

std::vector<NearestDescriptors> nearest_descriptors(const cv::Mat& from, const cv::Mat& into) {
  // So few rows stay in a core's fastest memory while all blocks pass by.
  constexpr int band_rows = 64;
  const DescriptorBlocks blocks = in_blocks(into);
  std::vector<NearestDescriptors> result(from.rows);
  tbb::parallel_for(tbb::blocked_range<int>(0, from.rows, band_rows), [&](const tbb::blocked_range<int>& rows) {
    for (int y = rows.begin(); y < rows.end(); y += band_rows) {
      const int count = std::min(band_rows, rows.end() - y);
      HWY_DYNAMIC_DISPATCH(find_nearest_part)
      (from.rowRange(y, y + count), blocks, std::span(result).subspan(y, count));
    }
  });
  return result;
}

}  // namespace wheatstone
#endif  // HWY_ONCE
