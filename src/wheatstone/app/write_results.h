#pragma once

#include <string>
#include <vector>

#include "wheatstone/app/output_folder.h"
#include "wheatstone/app/paint_photograph.h"
#include "wheatstone/app/report.h"

namespace wheatstone {

struct ResultOptions {
  bool photographs = false;    ///< also left_photograph and right_photograph, the pictures that were painted
  bool html = false;           ///< also these, and an index.html that shows the pictures
  bool svg = false;            ///< also left.svg and right.svg, the marks as vectors
  std::string format = "png";  ///< of the pictures to look at, as a file's ending
};

/// The names of all files that write_results writes, in its order.
std::vector<std::string> result_names(const ResultOptions& options = {});

/// Writes a painted photograph into a folder and commits it: left.png and right.png in the
/// photographs' own geometry; side_by_side.png and anaglyph.png as present_pair makes them; disparity.png,
/// left_disparity.pfm, right_disparity.pfm, left_occlusion.png, right_occlusion.png; painting.wst,
/// report.json; and what the options ask for. Masks and the disparity's picture are PNG in any format. Returns the
/// names written. Throws Error as the folder does; then nothing is committed.
std::vector<std::string> write_results(OutputFolder& folder, const StereoPair& photographs, const PaintingReport& told,
                                       const ResultOptions& options = {}, const Progress& progress = {});

}  // namespace wheatstone
