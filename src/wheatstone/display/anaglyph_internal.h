#pragma once

#include <array>

#include "wheatstone/display/anaglyph.h"

namespace wheatstone {

/// Rows: red, green and blue of the result; columns: red, green and blue of an eye.
using AnaglyphMatrix = std::array<std::array<float, 3>, 3>;

/// All that an anaglyph needs to be mixed without a power: matrices times the light of the eyes' code values, and the
/// sums from which on the result has each code value.
struct AnaglyphTables {
  std::array<float, 256> light{};
  std::array<std::array<float, 255>, 3> thresholds{};  ///< of red, green and blue: for the code values 1 to 255
  AnaglyphMatrix left, right;
  bool clips_eyes;  ///< to 0..1, before they are added
};
AnaglyphTables anaglyph_tables(const AnaglyphKind& kind);

}  // namespace wheatstone
