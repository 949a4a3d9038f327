#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// Whether these are the bytes of a PNG with the chunk acTL, which says that it has frames (APNG 1.0).
bool is_animated_png(std::string_view bytes);

/// The first frames of an animated PNG, each as a PNG of its own, but at most `most_frames`. Nothing where the file
/// breaks off, a checksum is wrong, or a frame does not replace the whole picture.
std::optional<std::vector<std::string>> frames_of_png(std::string_view bytes, int most_frames);

}  // namespace wheatstone
