#pragma once

#include <optional>

#include "compose.h"
#include "content.h"
#include "layers_apart.h"
#include "view_drawer.h"
#include "view_state.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::viewer {

/// Draws what is open as a state has it. Keeps drawn views, so that what moves pictures only (zero parallax, output
/// mode, the window's place) draws none anew. Of one thread.
class Stage {
 public:
  /// Throws Error where the mode cannot show the content.
  Frame draw(const Content& content, const ViewState& state, const Viewport& viewport, Effort effort = Effort::whole);

 private:
  Frame draw_display(const Content& content, const ViewState& state, const Viewport& viewport);
  Frame draw_eyes(const Content& content, const ViewState& state, const Viewport& viewport, Effort effort);

  Frame draw_apart(const PaintedContent& content, const ViewState& state, const Viewport& viewport);

  ViewDrawer drawer_;
  LayersApart layers_apart_;
  Content measured_;                ///< whose depth is known
  std::optional<DepthEnds> depth_;  ///< of that
};

/// The size of the screen whose lenses a state fills with views, in pixels; none where it shows no such views, or where
/// the size is not known.
std::optional<PictureSize> screen_size_of(const ViewState& state);

}  // namespace wheatstone::viewer
