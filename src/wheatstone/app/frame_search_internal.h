#pragma once

#include <fmt/format.h>

#include <cstdint>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/video/stereo_film.h"

namespace wheatstone {

/// The frames of a film that it is gone through for, in ascending order.
class FrameSearch {
 public:
  explicit FrameSearch(StereoFilmReader film) : film_(std::move(film)) {}

  /// A frame, counted from 0: the present one, or a later one.
  StereoFrame& at(std::int64_t frame) {
    if (frame + 1 == read_) return frame_;
    read_ += film_.skip(frame - read_);
    if (read_ != frame || !film_.read(frame_))
      throw Error(ErrorKind::bad_input,
                  fmt::format("the film ended after {} frames, expected more as at first", read_));
    ++read_;
    return frame_;
  }

 private:
  StereoFilmReader film_;
  StereoFrame frame_;
  std::int64_t read_ = 0;
};

}  // namespace wheatstone
