#pragma once

#include "wheatstone/image/image.h"

namespace wheatstone {

/// How much of two pictures of one size shows the same, moved mostly sideways, as two eyes see it.
struct BlockAgreement {
  int blocks = 0;    ///< that have enough texture to tell
  double share = 0;  ///< of those, 0..1: found in the other picture, found back from there, and moved as a neighbour is
};

/// Compares blocks of small copies by normalised correlation, up to a third of the width sideways and a few rows up and
/// down.
BlockAgreement block_agreement(ImageView<const Rgb8> a, ImageView<const Rgb8> b);

}  // namespace wheatstone
