#pragma once

#include <optional>
#include <vector>

#include "wheatstone/display/compose.h"
#include "wheatstone/display/view_framing.h"
#include "wheatstone/drawing/draw.h"

namespace wheatstone {

/// How a painting is shown: from where it is seen, how it lies in the pictures, over what, and as which picture. One
/// view is {.views = {position}}; for_two_eyes (two_eyes.h) and plan_display (app/display_views.h) make the others.
struct Presentation {
  std::vector<ViewPosition> views;
  Placement placement = {};
  std::optional<CoveredPart> covered = {};              ///< of each view; the rest is black; none: all of it
  std::vector<ImageView<const Rgb8>> backgrounds = {};  ///< of each view, as `draw` takes them; none: the canvas colour
  std::optional<DisplayComposition> composition = {};   ///< of one picture of all views; none: a picture for each view
  Device device = Device::processor;
  bool deep = false;  ///< also Presented::deep, as DrawOptions::deep. Not with bars or a composition
};

/// The pictures of a presentation.
struct Presented {
  std::vector<Image<Rgb8>> views;   ///< in the presentation's order; none where there is a composition
  std::vector<Image<Rgb16>> deep;   ///< of each of `views`, with 16 bits a channel, where that was asked for and drawn
  Image<Rgb8> composed;             ///< empty where there is no composition
  std::vector<double> bare_shares;  ///< of each of `views`: the share of the pixels, 0..1, of its covered part that
                                    ///< marks cover less than half
  double worst_bare_share = 0;      ///< of all views, composed or not
};

/// Draws a painting as a presentation wants it. A graphics processor that draws the views also composes them, in its
/// own memory, unless a part of the views is black. For lenses, it draws only those pixels of strokes of which the
/// screen shows something (Hassaine 2010, sec. 6.5.2); the worst bare share then refers to these pixels. If the
/// processor draws a quilt, only a few views are in memory beside it. Throws as `prepare`, `draw` and `compose` do.
Presented present(const Painting& painting, const Presentation& presentation);

}  // namespace wheatstone
