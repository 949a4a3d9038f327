#pragma once

// What the tests of stereo files look at: photographs where there are some, and a still life that is always there.

#include <filesystem>
#include <optional>
#include <string>

#include "scenes/still_life.h"
#include "shared_data.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/stereo_layout.h"

namespace wheatstone {

inline StereoPair still_for_test(int width = 480, int height = 360, std::uint64_t seed = 1) {
  return still_life(width, height, seed).pictures;
}

/// A pair of the shared data, as "teddy"; none where there are no data.
inline std::optional<StereoPair> shared_pair(const std::string& name) {
  const std::filesystem::path folder = shared_data() / "stereo" / name;
  for (const char* ending : {".png", ".jpg"}) {
    const std::filesystem::path left = folder / (std::string("left") + ending);
    if (std::filesystem::exists(left))
      return StereoPair{read_image(left), read_image(folder / (std::string("right") + ending))};
  }
  return {};
}

/// Two pictures in one, the first on the left or above.
inline Image<Rgb8> joined(const Image<Rgb8>& first, const Image<Rgb8>& second, bool side_by_side) {
  const int width = first.width(), height = first.height();
  Image<Rgb8> both(side_by_side ? 2 * width : width, side_by_side ? height : 2 * height);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      both(x, y) = first(x, y);
      both(side_by_side ? x + width : x, side_by_side ? y : y + height) = second(x, y);
    }
  }
  return both;
}

}  // namespace wheatstone
