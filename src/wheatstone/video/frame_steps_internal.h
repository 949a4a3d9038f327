#pragma once

// What every frame given to a writer must have in common with the one before.

#include <filesystem>
#include <optional>

#include "wheatstone/video/frame.h"

namespace wheatstone {

class FrameSteps {
 public:
  explicit FrameSteps(std::filesystem::path path) : path_(std::move(path)) {}

  /// Throws Error{wrong_usage} where a frame is empty, has another size or time base than the first, or does not come
  /// later than the last.
  void check(const Frame& frame);
  /// Throws Error{wrong_usage} where there was no frame.
  void check_any() const;

 private:
  struct First {
    int width = 0;
    int height = 0;
    Rational time_base;
  };
  std::filesystem::path path_;
  std::optional<First> first_;
  std::int64_t last_pts_ = 0;
};

}  // namespace wheatstone
