#pragma once

#include <array>
#include <vector>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A texture and smaller ones, each half as large as the one before, down to one pixel (Williams 1983). It repeats.
class ModelTexture {
 public:
  explicit ModelTexture(const Image<Rgb8>& picture);

  int width() const { return levels_.front().width(); }
  int height() const { return levels_.front().height(); }
  /// The level in which one pixel is as large as so many pixels of the texture across, between two of them.
  float level(float pixels_across) const;
  /// Linear light at a place of which 0, 0 is the lower left corner and 1, 1 the upper right one: interpolated in the
  /// two levels next to `level`.
  std::array<float, 3> at(float u, float v, float level) const;

 private:
  std::array<float, 3> in_level(std::size_t level, float u, float v) const;
  std::vector<Image<Rgb8>> levels_;
};

/// Linear light of all code values.
const std::array<float, 256>& linear_codes();

}  // namespace wheatstone
