#pragma once

#include <string>
#include <vector>

#include "wheatstone/display/stereo_card.h"

namespace wheatstone {

inline constexpr double inch_mm = 25.4;

/// The height of a caption's letters, and their lines.
struct CardCaption {
  double letter_mm = 0;
  std::vector<std::string> lines;
};

inline constexpr double card_line_step = 1.25;  ///< from line to line, in letters

[[noreturn]] void refuse_card_caption();

/// Makes the letters smaller until the lines fit their place: `lines_at` breaks the caption for a height in mm. Throws
/// Error{wrong_usage} where that takes letters that nobody reads.
template <class LinesAt>
CardCaption fitted_caption(const PaperArea& place, LinesAt lines_at) {
  constexpr double largest_mm = 3.2, least_mm = 1.6, step = 0.92;
  for (double letter_mm = largest_mm; letter_mm >= least_mm; letter_mm *= step) {
    CardCaption caption{letter_mm, lines_at(letter_mm)};
    if (static_cast<double>(caption.lines.size()) * letter_mm * card_line_step <= place.height_mm) return caption;
  }
  refuse_card_caption();
}

}  // namespace wheatstone
