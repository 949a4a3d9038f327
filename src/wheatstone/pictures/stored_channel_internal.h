#pragma once

#include <OpenImageIO/imageio.h>

#include <filesystem>
#include <string_view>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// One channel of numbers as a picture file stores them: integers as their values, floats as they are.
struct StoredChannel {
  Image<float> values;
  OIIO::TypeDesc type;
};

/// Whether a picture of several channels is taken.
enum class GreyInColours {
  refused,  ///< only one channel, and a second for alpha
  accepted  ///< where its colours are equal, as of grey pictures that were saved in colour
};

/// Reads the first channel. `what` stands for the file's content in messages: "a disparity map".
/// Throws Error{bad_input} where the file is no picture, damaged, or holds more than one channel of numbers.
StoredChannel read_stored_channel(const std::filesystem::path& path, std::string_view what, GreyInColours colours);

/// The same of a decoder that is open; `path` stands for it in messages.
StoredChannel read_stored_channel(OIIO::ImageInput& input, const std::filesystem::path& path, std::string_view what,
                                  GreyInColours colours);

/// The largest number that a stored type has: 255 and 65535; 1 for all others.
float full_scale(OIIO::TypeDesc type);

}  // namespace wheatstone
