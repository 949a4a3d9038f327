#include <fmt/format.h>

#include "wheatstone/error.h"
#include "wheatstone/video/frame_steps_internal.h"

namespace wheatstone {

void FrameSteps::check(const Frame& frame) {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: {}", path_.string(), what));
  };
  if (frame.picture.empty()) refuse("a frame without pixels, expected a picture");
  if (frame.time_base.numerator < 1 || frame.time_base.denominator < 1) {
    refuse(
        fmt::format("time base {}/{}, expected more than 0", frame.time_base.numerator, frame.time_base.denominator));
  }
  if (!first_) {
    first_ = First{frame.picture.width(), frame.picture.height(), frame.time_base};
  } else {
    if (frame.picture.width() != first_->width || frame.picture.height() != first_->height) {
      refuse(fmt::format("a frame of {}x{} pixels, expected {}x{} like the first", frame.picture.width(),
                         frame.picture.height(), first_->width, first_->height));
    }
    if (frame.time_base != first_->time_base) refuse("the time base changes, expected the first frame's");
    if (frame.pts <= last_pts_) {
      refuse(fmt::format("a frame at tick {} after one at {}, expected a later one", frame.pts, last_pts_));
    }
  }
  last_pts_ = frame.pts;
}

void FrameSteps::check_any() const {
  if (!first_)
    throw Error(ErrorKind::wrong_usage, fmt::format("{}: no frame was written, expected one", path_.string()));
}

}  // namespace wheatstone
