#pragma once

#include <optional>
#include <string>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A rectangle of whole pixels.
struct CardWindow {
  int left = 0, top = 0, width = 0, height = 0;
};

/// Where a stereograph card shows its two photographs: in the part of the picture that is card, after that part was
/// turned about its centre so that the card lies straight. Both are of one size.
struct CardWindows {
  CardWindow card;      ///< in the picture
  double turn_deg = 0;  ///< of the card in the picture, clockwise
  CardWindow left, right;
};

/// Finds the two photographs on a card: what is unlike the mount, whose colour the border shows, in two blocks of about
/// one size on both sides of the middle, or in one block whose halves show the same scene. Writing on the mount is left
/// aside. The card fills the picture or lies on a ground of one colour. Nothing where no such blocks are there.
std::optional<CardWindows> find_card_windows(ImageView<const Rgb8> picture);

StereoPair cut_card(ImageView<const Rgb8> picture, const CardWindows& windows);

/// "windows of 412x398 pixels at 30,20 and 470,20; the card is turned by 0.7 degrees".
std::string describe_card(const CardWindows& windows);

}  // namespace wheatstone
