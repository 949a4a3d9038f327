#pragma once

#include <cstdint>
#include <vector>

#include "multiview/baseline/light_band.h"
#include "wheatstone/image/image.h"
#include "wheatstone/image/srgb.h"

namespace wheatstone::baseline {

/// From linear light to a picture's bytes: L/(1+L) of the exposed light, as sRGB, by table.
struct ToneMap {
  static constexpr int table_size = 4096;
  explicit ToneMap(float exposure_) : exposure(exposure_) {
    for (int i = 0; i < table_size; ++i)
      table.push_back(srgb_from_linear(static_cast<float>(i) / static_cast<float>(table_size - 1)));
  }
  float exposure;
  std::vector<std::int32_t> table;
};

/// Tone-maps a band of light into a picture: columns 0 … width − 1 of the view.
void tone_map(const LightBand& band, const ToneMap& tone, int top, ImageView<Rgb8> picture);

}  // namespace wheatstone::baseline
