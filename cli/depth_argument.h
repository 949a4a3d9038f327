#pragma once

#include <string>
#include <string_view>

#include "command.h"
#include "stereo_arguments.h"
#include "wheatstone/stereo/disparity_from_depth.h"
#include "wheatstone/stereo/single_view.h"

namespace wheatstone::cli {

/// One picture's depth as it is typed.
struct DepthArguments {
  std::string file;      ///< empty: there is none
  std::string model;     ///< a network that finds it; empty: there is none
  bool carried = false;  ///< the picture's file has it: `file` is empty
  DepthKind kind = DepthKind::inverse;
  float strength = 0.03f;  ///< disparity from far to near, in widths
};

/// The name for --layout of a picture with its depth beside it.
inline constexpr auto depth_layout = "rgbd";
inline constexpr std::string_view depth_layout_words = "; rgbd for a picture with its depth beside it";

/// --depth, --depth-model, --depth-is and --strength of one picture; `no_depth` says where the strength has no effect,
/// and `no_map` where --depth-is has none, which needs --depth by default.
Rows depth_rows(DepthArguments& arguments, const Reason& no_depth, Reason no_map = {});

/// The same of the frames of a film of one eye.
Rows film_depth_rows(DepthArguments& arguments);

/// Whether a file or a network gives the depth.
bool has_depth(const DepthArguments& arguments);

/// "--depth" or "--depth-model", whichever gives it.
std::string option_of(const DepthArguments& arguments);

/// A pair that was made of one picture.
struct SinglePicture {
  MadePair pair;
  PictureSize whole;   ///< before it was reduced; 0: it was not
  float strength = 0;  ///< disparity from far to near, in widths
};

/// Reads one picture and its depth, which its own file may have, and makes a pair of them; says on standard error which
/// depth a file has. `photograph` tells the picture, its layout and the longest side. Throws Error: bad_input that
/// names the files.
SinglePicture read_single_picture(const StereoArguments& photograph, const DepthArguments& arguments,
                                  const Session& session);

}  // namespace wheatstone::cli
