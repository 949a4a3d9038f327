#include "wheatstone/stereo/occlusion.h"

#include <algorithm>
#include <cstddef>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

#include "wheatstone/image/mat_opencv.h"

namespace wheatstone {
namespace {

/// Set pixels beside each other in a row of a mask, and the set of runs that they belong to.
struct Run {
  int row, begin, end;
  std::size_t joined_to;  ///< another run of its set; itself for the one that stands for the set
  int pixels;             ///< of the set
};

/// The runs of a mask, as sets that touch each other at sides or corners. Masks are empty nearly everywhere.
class TouchingRuns {
 public:
  explicit TouchingRuns(ImageView<const std::uint8_t> mask) {
    std::size_t above = 0;
    for (int y = 0; y < mask.height(); ++y) {
      const std::size_t first = runs_.size();
      const auto row = mask.row(y);
      const auto is_set = [](std::uint8_t value) { return value != 0; };
      for (auto end = row.begin();;) {
        const auto begin = std::find_if(end, row.end(), is_set);
        if (begin == row.end()) break;
        end = std::find(begin, row.end(), 0);
        add({y, static_cast<int>(begin - row.begin()), static_cast<int>(end - row.begin()), runs_.size(),
             static_cast<int>(end - begin)},
            above, first);
      }
      above = first;
    }
  }

  /// Calls `visit` with each run and the number of pixels that its set has.
  template <class Visit>
  void visit(Visit visit) {
    for (std::size_t i = 0; i < runs_.size(); ++i) visit(runs_[i], runs_[set_of(i)].pixels);
  }

 private:
  /// Runs from `above` to before `first` are those of the row above; `above` goes on to those that end behind this
  /// one's begin.
  void add(const Run& run, std::size_t& above, std::size_t first) {
    runs_.push_back(run);
    while (above < first && runs_[above].end < run.begin) ++above;
    for (std::size_t i = above; i < first && runs_[i].begin <= run.end; ++i) join(i, runs_.size() - 1);
  }

  std::size_t set_of(std::size_t run) {
    while (runs_[run].joined_to != run) {
      runs_[run].joined_to = runs_[runs_[run].joined_to].joined_to;  // shorter for the next time
      run = runs_[run].joined_to;
    }
    return run;
  }

  void join(std::size_t a, std::size_t b) {
    a = set_of(a);
    b = set_of(b);
    if (a == b) return;
    if (runs_[a].pixels < runs_[b].pixels) std::swap(a, b);
    runs_[b].joined_to = a;
    runs_[a].pixels += runs_[b].pixels;
  }

  std::vector<Run> runs_;
};

}  // namespace

Image<std::uint8_t> dilate_occlusion(ImageView<const std::uint8_t> occlusion, int radius_px) {
  Image<std::uint8_t> dilated(occlusion.width(), occlusion.height());
  cv::Mat target = as_mat(dilated);
  cv::dilate(as_mat(occlusion), target,
             cv::getStructuringElement(cv::MORPH_RECT, {2 * radius_px + 1, 2 * radius_px + 1}));
  return dilated;
}

void remove_occlusion_specks(Image<std::uint8_t>& occlusion, int least_px) {
  TouchingRuns(occlusion).visit([&](const Run& run, int pixels) {
    std::fill_n(&occlusion(run.begin, run.row), run.end - run.begin, pixels >= least_px ? 255 : 0);
  });
}

}  // namespace wheatstone
