#pragma once

#include <CLI/CLI.hpp>
#include <string>

#include "command.h"
#include "stereo_arguments.h"
#include "wheatstone/stereo/disparity_from_depth.h"
#include "wheatstone/stereo/single_view.h"

namespace wheatstone::cli {

/// The heading of these options in the help.
inline constexpr auto depth_options_group = "One picture and its depth";

/// One picture's depth as it is typed.
struct DepthArguments {
  std::string file;      ///< empty: there is none
  std::string model;     ///< a network that finds it; empty: there is none
  bool carried = false;  ///< the picture's file has it: `file` is empty
  DepthKind kind = DepthKind::inverse;
  std::string strength = "3%";
};

/// The name for --layout of a picture with its depth beside it.
inline constexpr auto depth_layout = "rgbd";

/// Adds --depth, --depth-model, --depth-is and --strength.
void add_depth_options(CLI::App& command, DepthArguments& arguments);

/// The same for the frames of a film of one eye.
void add_film_depth_options(CLI::App& command, DepthArguments& arguments);

/// Whether a file or a network gives the depth.
bool has_depth(const DepthArguments& arguments);

/// "3%" or ".03" as a share. Throws Error{wrong_usage}.
float parse_strength(const std::string& text);

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
