#pragma once

#include <functional>
#include <string>
#include <vector>

#include "wheatstone/multiview/tone.h"

namespace wheatstone {

/// A number beside a colour bar.
struct Tick {
  float place;  ///< 0..1, from the bar's lower end to its upper one
  std::string label;
};

struct ColourBarTicks {
  std::vector<Tick> ticks;  ///< two or more, ascending
  int exponent = 0;         ///< labels count in this power of ten
};

/// The round numbers of a bar of so many pixels whose labels stay apart from each other by `gap_px`: even steps where
/// brightness is linear, powers of ten and 1, 2, 5 between them where it is logarithmic. The limits of the tone are in
/// the unit that is shown. `widths_of` tells how wide labels are, in pixels.
ColourBarTicks colour_bar_ticks(const ToneSettings& tone, int length_px, int gap_px,
                                const std::function<std::vector<int>(const std::vector<std::string>&)>& widths_of);

}  // namespace wheatstone
