#pragma once

#include <optional>
#include <string>

#include "wheatstone/calibration/rectify.h"
#include "wheatstone/matching/eye_order.h"
#include "wheatstone/progress.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// Whether a pair is rectified before it is matched.
enum class RectifyPolicy {
  automatic,  ///< where their rows do not fit, and rectifying makes them fit better
  never,      ///< the pictures are taken as they are
  always,     ///< as `rectify` does, from what the pictures have in common
};

struct PreparePairOptions {
  RectifyPolicy rectify = RectifyPolicy::automatic;
  bool keep_size = false;  ///< as RectifyOptions has it
  bool ask_eyes = true;    ///< whether `eyes` is looked for
};

/// A pair that can be matched, and how well its rows fit.
struct PreparedPair {
  StereoPair pictures;                                 ///< upright, of one scene; rectified where that was wanted
  int compared_features = 0;                           ///< that both pictures show
  std::optional<VerticalDisparity> photographed_rows;  ///< of the photographs; none: too few features to tell
  std::optional<VerticalDisparity> rows;               ///< of `pictures`
  VerticalDisparity tolerated{1, 3};                   ///< up to which a pair counts as rectified
  std::optional<Rectification> rectification;          ///< none: the pictures are the photographs
  std::optional<ColourTransfer> colour;                ///< of a rectified pair, as RectifiedPair has it
  std::string why_not_rectified;                       ///< where that was tried and failed; empty: it was not
  EyeOrder eyes = EyeOrder::undecided;                 ///< of `pictures`, where that was asked
};

/// Looks for what makes two pictures no pair, and rectifies them where that is wanted. The rows are measured on
/// features (SIFT) of copies whose longer side is at most 960 pixels, a fifth of the time that matching takes. Rows do
/// not fit where their differences have a median or a 95th percentile above `tolerated`: 1 and 3 pixels; in large
/// pictures a quarter of the copies' pixels, and a thousandth of the longer side, which is how far off features that
/// count as right may be. Throws
/// Error{bad_input}: sizes differ; a picture is blank; one of them is upside down, turned by 90 degrees or mirrored
/// against the other; they show different scenes; and as `rectify` where the pair is always to be rectified.
PreparedPair prepare_pair(StereoPair photographs, const PreparePairOptions& options = {},
                          const Progress& progress = {});

/// One sentence that says from which row difference to which a pair was rectified, and how much of the photographs is
/// kept; empty where it was not.
std::string rectified_note(const PreparedPair& pair);

/// One sentence that says how much of the photographs rectifying cuts off; empty where that is at most a tenth.
std::string area_warning(const PreparedPair& pair);

/// One sentence that names the row difference and what helps; empty where the rows fit or could not be compared.
std::string row_warning(const PreparedPair& pair);

}  // namespace wheatstone
