#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "wheatstone/display/compose.h"
#include "wheatstone/display/quilt.h"
#include "wheatstone/gpu/gpu.h"
#include "wheatstone/marks/slicing.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::cli {

/// Views as they are typed: pictures, a folder of them, one file that holds several, a painting or slices.
struct ViewsArguments {
  std::vector<std::string> files;
  std::string layout;                 ///< of one picture that holds two
  std::optional<QuiltLayout> quilt;   ///< of one picture that is a quilt
  bool swap = false;                  ///< right to left
  int views = 0;                      ///< of slices; 0: what the packing wants
  float span = 1;                     ///< of slices, in eye separations
  Device device = Device::processor;  ///< of paintings
  Slicing slicing = {};               ///< of paintings
  bool keep_profile = false;          ///< leave pictures in their files' ICC profile, where all share one
  /// Whether the output is named as one file: then a folder holds views. None: it may hold photographs.
  std::function<bool()> into_one_file = {};
  /// Where all that is wanted is one picture of the views: paintings are drawn into it.
  std::optional<DisplayComposition> composition = {};
};

/// The files, and --layout, --from-quilt, --swap, --views and --span. `makes_views` says whether views are made of a
/// photograph, too: then --span has an effect on it.
Rows views_rows(ViewsArguments& arguments, const std::function<bool()>& makes_views);

/// Whether the input is two files, or one picture, which may hold two views or have depth; or a folder of such.
bool is_photograph(const ViewsArguments& arguments);

/// Whether it is a folder of photographs.
bool is_photograph_folder(const ViewsArguments& arguments);

/// Why an option that is of paintings has no effect.
Reason unless_painting(const ViewsArguments& arguments);

/// --device, with which paintings are drawn.
Row views_device_row(ViewsArguments& arguments);

struct ReadViews {
  std::vector<Image<Rgb8>> views;   ///< left to right, of one size
  std::string how;                  ///< in words, where they come from
  std::string colour_profile = {};  ///< of the views, where it was to be kept and they share one; empty: sRGB

  /// Of a painting where one picture was wanted: then there are no views, but it is composed of so many of this size.
  Image<Rgb8> composed = {};
  int count = 0;
  PictureSize size = {0, 0};
};

/// A painting that can be drawn for so many views as are wanted, 0 for its eyes; not sliced. Throws Error{bad_input}
/// where it holds what two eyes show and other views are wanted.
Painting read_painting_argument(const ViewsArguments& arguments, int wanted);

/// Draws it: the eyes' own pictures, or as many views as are wanted, with the middle of the scene's disparities on the
/// screen.
ReadViews draw_painting_argument(const Painting& painting, const ViewsArguments& arguments, int wanted,
                                 const Progress& progress);

/// A painting that can be drawn for any view. Throws Error{bad_input} where it holds what two eyes show.
Painting read_painting_for_views(const std::string& file);

/// The files that reading the views reads: those of a folder instead of the folder.
std::vector<std::filesystem::path> files_read(const ViewsArguments& arguments);

/// Reads or makes the views. `wanted` is how many the packing needs where they are made; 0: no matter.
/// Throws Error: bad_input, wrong_usage.
ReadViews read_views_argument(const ViewsArguments& arguments, int wanted, const Session& session);

}  // namespace wheatstone::cli
