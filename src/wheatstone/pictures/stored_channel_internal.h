#pragma once

#include <filesystem>
#include <string_view>

#include "wheatstone/image/image.h"
#include "wheatstone/pictures/picture_file.h"

namespace wheatstone {

/// One channel of numbers as a picture file stores them: integers as their values, floats as they are.
struct StoredChannel {
  Image<float> values;
  NumberKind kind;
};

/// Whether a picture of several channels is taken.
enum class GreyInColours {
  refused,  ///< only one channel, and a second for alpha
  accepted  ///< where its colours are equal, as of grey pictures that were saved in colour
};

/// Reads the first channel of a picture file, whose bytes are these: PNG and JPEG are decoded from them, other formats
/// are read from the file itself. `what` stands for the content in messages: "a disparity map". Throws Error{bad_input}
/// where the file is no picture, damaged, or holds more than one channel of numbers.
StoredChannel read_stored_channel(std::string_view bytes, const std::filesystem::path& path, std::string_view what,
                                  GreyInColours colours);

/// The largest number that bytes and words have: 255 and 65535; 1 for all others.
float full_scale(NumberKind kind);

}  // namespace wheatstone
