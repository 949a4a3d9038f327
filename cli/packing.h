#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "command.h"
#include "wheatstone/calibration/prepare_pair.h"
#include "wheatstone/display/compose.h"
#include "wheatstone/display/lenticular.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/display/view_framing.h"
#include "wheatstone/image/image.h"
#include "write_views_output.h"

namespace wheatstone::cli {

/// A packing as it is typed.
struct PackingArguments {
  std::string to;      ///< empty: by the output's ending
  std::string screen;  ///< of lenticular: a display, or a calibration file
  std::optional<QuiltLayout> quilt;
  std::string display;                               ///< a preset, whose format is taken
  std::string format = "png";                        ///< of views, and of a quilt without an ending
  int quality = 95;                                  ///< of JPEG, MPO, JPS
  double seconds = 0.5;                              ///< of a wiggle, there and back
  RectifyPolicy rectify = RectifyPolicy::automatic;  ///< of views that are matched
  float depth_scale = 1;                             ///< of depth: camera separation times focal length in pixels
  double dpi = 300;                                  ///< of a stereo card: pixels an inch
  ViewFraming framing;                               ///< of views on a display or a card of another shape
};

struct PackingFormat;

/// A packing that was chosen, with what its format needs.
struct Packing {
  const PackingFormat* format;
  std::string name;                        ///< as it was typed, or by the output's ending
  std::optional<QuiltLayout> quilt;        ///< of a quilt
  double aspect = 0;                       ///< of a quilt's display; 0: a view's own
  std::optional<LenticularScreen> screen;  ///< of a lenticular picture
};

/// What a format writes, and where.
struct PackingJob {
  const Packing& packing;
  const PackingArguments& arguments;
  std::span<const Image<Rgb8>> views;
  const std::string& caption;   ///< of a format that sets it itself
  const Image<Rgb8>& composed;  ///< the format's picture, where it is made already; then there are no views
  const ViewsOutput& output;
  const Session& session;
};

/// One line of the table of formats, from which the parser, the names in --help and the writer are made.
struct PackingFormat {
  std::string_view name;
  std::string_view alias;   ///< ffmpeg's name; empty: it has none
  std::string_view ending;  ///< of the outputs that are packed so where no format is named; empty: none
  int views;                ///< that it takes; 0: any number
  /// Returns the name of what was written. None of slices, which are not made of views.
  std::function<std::string(const PackingJob&)> write;
  /// Of a format that is one picture in which every view has its place: how.
  std::function<DisplayComposition(const Packing&)> composition = {};
};

/// The table: anaglyphs and layouts of two eyes from their own tables, then the formats that need more than two views'
/// pictures.
std::span<const PackingFormat> packing_formats();

/// `output` is the name of the output, which may say the packing. Refused where the packing has no use for them.
Rows packing_rows(PackingArguments& arguments, const std::string& output);

/// What was asked for, by name or by the output's ending. Throws Error{wrong_usage} that lists what there is.
Packing find_packing(const PackingArguments& arguments, const std::string& output);

/// The ending of the packed file of one of several photographs, as ".mpo"; empty where views get a folder, and a quilt
/// its own name. `format_is_given`: --format decides where it can.
std::string ending_for(const Packing& packing, const PackingArguments& arguments, bool format_is_given);

/// Throws Error{wrong_usage} where the output has an ending that the packing cannot be written under.
void check_ending(const Packing& packing, const std::string& output);

/// A reason that holds for packings that do not match the views, and one for those that do.
Reason unless_matched(const PackingArguments& arguments, const std::string& output);
Reason if_matched(const PackingArguments& arguments, const std::string& output);

/// A reason that holds for a stereo card, which has a mount.
Reason if_card(const PackingArguments& arguments, const std::string& output);

/// Whether the format sets the caption itself, instead of below each view.
bool sets_caption(const Packing& packing);

/// Whether the packing shows the views' own colours, in a file that can say their ICC profile. Anaglyphs mix colours
/// for glasses, and what a display takes goes to it as it is: they are sRGB.
bool keeps_profile(const Packing& packing, const PackingArguments& arguments, const std::string& output);

/// How many views the packing needs; 0: any number.
int views_wanted(const Packing& packing);

/// Writes the views and returns the name of what was written. Throws Error: wrong_usage where the packing takes another
/// number of views or the output another ending, cannot_read_write.
std::string write_packed(const PackingJob& job);

}  // namespace wheatstone::cli
