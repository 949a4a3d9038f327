#pragma once

#include <optional>
#include <string>

#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/place_depth.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/gpu/device.h"
#include "wheatstone/marks/painting.h"
#include "wheatstone/progress.h"

namespace wheatstone {

/// The same painting, `scale` times as large: marks are shapes, so nothing is lost.
/// Throws Error{wrong_usage} where the result would be over 65535 pixels a side.
Painting scaled(const Painting& painting, double scale);

/// That of the nearest mark, but for outliers; 0 where there are no marks.
float nearest_disparity(const Painting& painting);

struct RedrawOptions {
  double scale = 1;            ///< how many times as large
  bool svg = false;            ///< also left.svg and right.svg, the marks as vectors
  std::string format = "png";  ///< of the pictures, as a file's ending
  /// Disparity on the screen plane, in pixels of the result; none: that of the nearest mark, but for outliers.
  std::optional<float> zero_parallax_px = std::nullopt;
  std::optional<float> depth_budget = comfortable_parallax_share;  ///< of what is looked at, as comfortable_separation
  DepthPlacing depth = {};  ///< with regions they say what lies on the screen, and there is no budget
  Device device = Device::processor;
};

/// Draws a painting again, for both eyes, over its canvas colour: left.png, right.png, side_by_side.png and
/// anaglyph.png, or in another format, in a folder, which is committed. Throws Error as the folder and `scaled` do.
void draw_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options = {},
                const Progress& progress = {});

}  // namespace wheatstone
