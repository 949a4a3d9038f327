#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "wheatstone/video/frame.h"

namespace wheatstone {

/// A moment of a film in seconds, as ffmpeg takes it: "12.5", "1:02", "1:02:03.5". Nothing where the text is anything
/// else.
std::optional<double> film_time_from(std::string_view text);

/// The moment to a millisecond: "0:02.500", or "1:00:02.500" from an hour on. Seconds must not be negative.
std::string film_time_text(double seconds);

/// When a frame is shown.
inline double seconds_of(const StereoFrame& frame) { return static_cast<double>(frame.pts) * frame.time_base.value(); }

}  // namespace wheatstone
