#pragma once

#include <array>
#include <string>

#include "wheatstone/display/view_framing.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// A rectangle on paper, in millimetres from the card's upper left corner.
struct PaperArea {
  double left_mm = 0, top_mm = 0, width_mm = 0, height_mm = 0;
};

/// A stereograph card for Holmes' stereoscope: 7 by 3 1/2 inches, with two windows whose middles are 83 mm apart and
/// whose corners are round. The caption stands below them.
struct StereoCardLayout {
  double width_mm = 178, height_mm = 89, corner_mm = 5;
  std::array<PaperArea, 2> windows;
  PaperArea caption;
};

struct StereoCardOptions {
  std::string caption;  ///< UTF-8; may be empty
  ViewFraming framing;  ///< of the views in the windows; where they are whole, the windows take their shape
  double dpi = 300;     ///< pixels an inch, of a PDF at most
  Rgb8 mount{238, 230, 213}, ink{66, 54, 44};
};

/// The layout for views of this size.
StereoCardLayout stereo_card_layout(int view_width, int view_height, const ViewFraming& framing);

/// The card as a picture. Throws Error{wrong_usage} where the caption does not fit below the windows, and as set_text.
Image<Rgb8> stereo_card_picture(const StereoPairView& pair, const StereoCardOptions& options);

/// The card as a PDF of one page of the card's size: the views as JPEG with not more pixels than they have, the caption
/// as text. Throws likewise.
std::string stereo_card_pdf(const StereoPairView& pair, const StereoCardOptions& options);

}  // namespace wheatstone
