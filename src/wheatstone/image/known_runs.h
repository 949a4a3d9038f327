#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A map of numbers of which many may be unknown (NaN): only the runs of known pixels of each row take memory.
class KnownRuns {
 public:
  /// Columns [begin, end) of a row, and where their values begin.
  struct Run {
    int begin, end;
    std::size_t first_value;
    friend bool operator==(const Run&, const Run&) = default;
  };

  KnownRuns() : KnownRuns(0, 0) {}
  /// Without rows, which add_row adds from the top; `height` says how many are expected.
  KnownRuns(int width, int height);
  explicit KnownRuns(ImageView<const float> map);

  /// Adds a row of `width()` pixels.
  void add_row(std::span<const float> row);

  int width() const { return width_; }
  int height() const { return static_cast<int>(first_runs_.size()) - 1; }
  bool empty() const { return width() == 0 || height() == 0; }
  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height(); }
  float operator()(int x, int y) const;
  /// One row with its unknown pixels; `to` has `width()` pixels.
  void copy_row(int y, std::span<float> to) const;

  std::span<const Run> runs_of(int y) const {
    const auto row = static_cast<std::size_t>(y);
    return std::span(runs_).subspan(first_runs_[row], first_runs_[row + 1] - first_runs_[row]);
  }
  std::span<const float> values_of(const Run& run) const {
    return values().subspan(run.first_value, static_cast<std::size_t>(run.end - run.begin));
  }
  std::span<float> values_of(const Run& run) {
    return values().subspan(run.first_value, static_cast<std::size_t>(run.end - run.begin));
  }

  std::span<const Run> runs() const { return runs_; }                      ///< of all rows, from the top
  std::span<const std::size_t> first_runs() const { return first_runs_; }  ///< of each row, and the number of all
  std::span<const float> values() const { return values_; }                ///< of all runs; none is NaN
  std::span<float> values() { return values_; }

  friend bool operator==(const KnownRuns&, const KnownRuns&) = default;

 private:
  int width_;
  std::vector<Run> runs_;
  std::vector<std::size_t> first_runs_;
  std::vector<float> values_;
};

}  // namespace wheatstone
