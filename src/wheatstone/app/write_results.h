#pragma once

#include <optional>
#include <string>
#include <vector>

#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/report.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/pictures/picture_notes.h"

namespace wheatstone {

struct ResultOptions {
  bool flat = false;           ///< of one picture without depth: painted.png, painting.wst, report.json, painted.svg
  bool photographs = false;    ///< also left_photograph and right_photograph, the pictures that were painted
  bool html = false;           ///< also these, and an index.html that shows the pictures
  bool svg = false;            ///< also left.svg and right.svg, the marks as vectors
  std::string format = "png";  ///< of the pictures to look at, as a file's ending
  PictureNotes notes = {};     ///< what these pictures say of the photograph
};

/// The names of all files that write_results writes, in its order.
std::vector<std::string> result_names(const ResultOptions& options = {});

/// Writes a painted photograph into a folder and commits it: left.png and right.png in the
/// photographs' own geometry; side_by_side.png and anaglyph.png for the nearer eyes, if any, with the zero-parallax
/// plane on the screen; disparity.png, left_disparity.pfm and .png, right_disparity.pfm, left_occlusion.png,
/// right_occlusion.png; painting.wst, report.json; and what the options ask for. Masks and the disparity's picture are
/// PNG in any format. Of one picture without depth it
/// writes painted.png, painting.wst, report.json and painted.svg. Returns the names written. Throws Error as the folder
/// does; then nothing is committed.
std::vector<std::string> write_results(OutputFolder& folder, const StereoPair& photographs, const PaintingReport& told,
                                       const ResultOptions& options = {}, const Progress& progress = {});

/// The same painting, `scale` times as large: marks are shapes, so nothing is lost.
/// Throws Error{wrong_usage} where the result would be over 65535 pixels a side.
Painting scaled(const Painting& painting, double scale);

struct RedrawOptions {
  double scale = 1;            ///< how many times as large
  bool svg = false;            ///< also left.svg and right.svg, the marks as vectors
  std::string format = "png";  ///< of the pictures, as a file's ending
  /// Disparity on the screen plane, in pixels of the result; none: that of the nearest mark, without outliers.
  std::optional<float> zero_parallax_px = std::nullopt;
  std::optional<float> depth_budget = comfortable_parallax_share;  ///< of what is looked at, as comfortable_separation
  DepthPlacing depth = {};  ///< with regions they say what lies on the screen, and there is no budget
  Device device = Device::processor;
};

/// Draws a painting again, for both eyes, over its canvas colour: left.png, right.png, side_by_side.png and
/// anaglyph.png, or in another format, in a folder, which is committed; of a flat painting painted.png alone. Throws
/// Error as the folder and `scaled` do.
void draw_again(const Painting& painting, OutputFolder& folder, const RedrawOptions& options = {},
                const Progress& progress = {});

}  // namespace wheatstone
