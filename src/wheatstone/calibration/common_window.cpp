#include <algorithm>
#include <utility>
#include <vector>

#include "wheatstone/calibration/common_window_internal.h"

namespace wheatstone {

cv::Rect largest_rectangle_within(const cv::Mat& mask) {
  cv::Rect best;
  std::vector<int> reach(static_cast<std::size_t>(mask.cols) + 1, 0);  // filled pixels upwards; a last column of none
  std::vector<std::pair<int, int>> open;  // rectangles that still grow to the right: first column, height
  for (int y = 0; y < mask.rows; ++y) {
    const auto* row = mask.ptr<std::uint8_t>(y);
    for (int x = 0; x < mask.cols; ++x) reach[x] = row[x] != 0 ? reach[x] + 1 : 0;
    open.clear();
    for (int x = 0; x <= mask.cols; ++x) {
      int first = x;
      while (!open.empty() && open.back().second >= reach[x]) {
        const auto [begin, height] = open.back();
        open.pop_back();
        first = begin;
        const cv::Rect found(begin, y - height + 1, x - begin, height);
        if (static_cast<std::int64_t>(found.width) * found.height > static_cast<std::int64_t>(best.width) * best.height)
          best = found;
      }
      if (reach[x] > 0) open.emplace_back(first, reach[x]);
    }
  }
  return best;
}

}  // namespace wheatstone
