#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "wheatstone/matching/match_internal.h"
#include "wheatstone/matching/semi_global_strip_internal.h"

namespace wheatstone {
namespace {

/// Rows of a strip, and rows beside it on either side that lead the paths into it. All sizes of costs of a strip and a
/// thread: 300 rows of 4000 pixels and 16 disparities are 58 MB.
constexpr int strip_rows = 224, lead_rows = 40;

cv::Mat grey_with_border(const cv::Mat& picture) {
  cv::Mat grey;
  cv::cvtColor(picture, grey, cv::COLOR_RGB2GRAY);
  cv::copyMakeBorder(grey, grey, census_down, census_down, census_across, census_across, cv::BORDER_REFLECT_101);
  cv::copyMakeBorder(grey, grey, 0, 0, 0, row_margin, cv::BORDER_REPLICATE);
  return grey;
}

}  // namespace

BandMatch match_semi_global(const cv::Mat& left, const cv::Mat& right, const SearchBand& band) {
  ComparedPictures pictures{left, {}, {}, {}, false};
  BandMatch result;
  tbb::parallel_invoke([&] { pictures.left_grey = grey_with_border(left); },
                       [&] {
                         cv::flip(right, pictures.right, 1);
                         pictures.right_grey = grey_with_border(pictures.right);
                       },
                       [&] {
                         result = {
                             Image<float>(left.cols, left.rows, unknown), Image<float>(left.cols, left.rows, unknown),
                             Image<std::uint8_t>(left.cols, left.rows), Image<std::uint8_t>(left.cols, left.rows)};
                       });
  const auto first = band.first.pixels();
  pictures.one_band = std::ranges::all_of(first, [&](std::int16_t value) { return value == first.front(); });
  const int strips = (left.rows + strip_rows - 1) / strip_rows;
  tbb::enumerable_thread_specific<StripMemory> memory;
  tbb::parallel_for(0, strips, [&](int i) {
    const int begin = i * strip_rows, end = std::min(begin + strip_rows, left.rows);
    const Strip strip{std::max(begin - lead_rows, 0), begin, end, std::min(end + lead_rows, left.rows)};
    match_strip(pictures, band, strip, memory.local(), result);
  });
  return result;
}

}  // namespace wheatstone
