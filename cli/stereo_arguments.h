#pragma once

#include <string>
#include <string_view>

#include "command.h"
#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/matching/match_confidence.h"
#include "wheatstone/stereo/picture_sizes.h"
#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone::cli {

/// Photographs as they are typed: two files, or one that holds both views.
struct StereoArguments {
  std::string left, right;  ///< right is empty where left holds both
  std::string layout;       ///< of one picture that holds both; empty: find it
  bool swap = false;
  RectifyPolicy rectify = RectifyPolicy::automatic;
  bool may_be_flat = false;   ///< one picture without depth will do, too: where nothing says that it holds two views
  int max_size = 0;           ///< longer side of what is worked on, in pixels; 0: as large as it is
  bool keep_profile = false;  ///< leave the pictures in the files' ICC profile, where they share one
};

/// --layout, --swap, --max-size and --rectify. `also` is said behind the names of the layouts.
Row layout_row(std::string& layout, Reasons unless = {}, std::string_view also = {});
Row swap_row(bool& swap, Reasons unless = {});
Row max_size_row(int& longest_px, Reasons unless = {});
Row rectify_row(RectifyPolicy& policy, Reasons unless = {});

/// LEFT and RIGHT, two files or one that holds both.
Rows pair_rows(StereoArguments& arguments);

/// Reads "FILE" or "FILE:SCALE": disparity in pixels is the stored value divided by the scale. A file whose own name
/// has a colon is taken as it is. Throws Error as read_disparity.
Image<float> read_disparity_argument(const std::string& argument);

/// Reads two photographs. Throws Error{bad_input} that names both where their sizes differ.
StereoPair read_pair(const std::string& left, const std::string& right);

/// As prepare_pair; what is wrong gets `name`, that of the files.
PreparedPair prepare_named_pair(StereoPair pair, const PreparePairOptions& options, const std::string& name,
                                const Session& session);

/// Says on standard error, under the files' name, that a pair was rectified, and where its rows do not fit.
void tell_of_rows(const PreparedPair& pair, const std::string& name, const Session& session);

/// What a summary says of the order of the eyes where the pictures do not tell it; empty where they do.
std::string_view undecided_eyes(const PreparedPair& pair);

/// A pair as its files have it.
struct NamedPair {
  StereoPair pictures;
  std::string name;  ///< for messages: of both files, or of one and how it was understood
  std::string note;  ///< a line that says how one file was understood; empty: two files
  bool eyes_known_from_picture = false;
  std::string colour_profile = {};  ///< of the pictures, where it was to be kept and they share one; empty: sRGB
  std::string framed = {};  ///< a line that says that two files were framed to their common part; empty: they were not
};

/// Reads photographs from two files or one. Throws Error: bad_input, wrong_usage.
NamedPair read_named_pair(const StereoArguments& arguments);

/// Says on standard error how one file was understood, once nothing is wrong with it.
void tell_of_layout(const NamedPair& pair, const Session& session);

/// A pair that was read and prepared.
struct ReadPhotograph {
  PreparedPair pair;
  PictureSize whole;  ///< before it was reduced; 0: it was not
  std::string name;   ///< for messages
};

/// Says on standard error, under the files' name, why a match is poor, where the rows do not tell it already.
void tell_of_match(const ReadPhotograph& photograph, const MatchConfidence& confidence, const Session& session);

/// Reads photographs from two files or one, of which the right one is empty where a flat picture will do and is given,
/// and says on standard error how one was understood, and where the eyes look swapped. Where `disparity_is_given` they
/// are taken as they are, and else prepared for matching: what makes them no pair is refused; that it was rectified,
/// and rows that do not fit, are told on standard error. Throws Error: bad_input, wrong_usage.
ReadPhotograph read_photographs(const StereoArguments& arguments, bool disparity_is_given, const Session& session);

}  // namespace wheatstone::cli
