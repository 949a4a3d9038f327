#pragma once

#include <cstdint>
#include <vector>

#include "wheatstone/multiview/tone.h"

namespace wheatstone {

/// From sums of light to a picture's bytes, by table. Of the thesis's look each channel becomes L/(1+L) (Hassaine 2010,
/// eq. 5.8.1), or stays what it is up to 1. Of mass the brightness comes from one number, and the hue stays what it is.
struct ToneMap {
  static constexpr int table_size = 4096;
  static constexpr int brightnesses = 256;
  // The stretch is looked up by a number's exponent and the first bits of its mantissa.
  static constexpr int index_shift = 16;
  static constexpr int stretch_size = 26 << (23 - index_shift);
  static constexpr std::int32_t first_index = (127 - 25) << (23 - index_shift);  ///< of 2^−25

  /// The limits or the exposure are known.
  explicit ToneMap(const ToneSettings& settings);
  Rgb8 operator()(float first, float second, float third) const;
  bool three_channels() const { return look == Look::thesis || shown == Shown::colours; }

  Look look;
  Shown shown;
  float exposure;
  bool bounded;                       ///< of the thesis's look: what is shown stays what it is, up to 1
  std::vector<std::int32_t> table;    ///< sRGB of linear light times table_size − 1
  float scale = 1, offset = 0;        ///< from what is shown to 0..1 between the limits
  int hues = 1;                       ///< of the ramp
  std::vector<std::int32_t> stretch;  ///< brightness times `hues`, by index
  std::vector<float> linear_stretch;  ///< the same as linear light
  std::vector<std::int32_t> colours;  ///< red + 256·green + 65536·blue, by brightness and hue
};

}  // namespace wheatstone
