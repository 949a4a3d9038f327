#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command.h"
#include "options.h"
#include "wheatstone/display/print_frame.h"
#include "wheatstone/pictures/picture_notes.h"

namespace wheatstone::cli {

/// Strips of a floating window: as they are typed, or none, which is "auto".
using TypedWindow = std::optional<FloatingWindow>;

/// What is put around views, and what goes into their files beside them, as it is typed.
struct PrintArguments {
  PrintFrame frame;                            ///< without the caption's text
  std::string caption;                         ///< with placeholders; empty: none
  bool keep_location = false;                  ///< where the photograph was taken
  std::optional<TypedWindow> floating_window;  ///< none: there is none
};

/// --crop, --border, --caption, --keep-location and --floating-window. `unless_framed` are reasons against a border and
/// a caption, `unless_bordered` further ones against a border, and `unless_floating` those against a floating window.
Rows print_rows(PrintArguments& arguments, const Reasons& unless_framed, Reasons unless_bordered,
                Reasons unless_floating);

/// A part of each view, shifted by `shift_px` from each view to the next, with a floating window and a frame where
/// these are wanted. Throws Error{wrong_usage} where a part or a window does not fit.
std::vector<Image<Rgb8>> put_in_frame(std::vector<Image<Rgb8>> views, const PrintArguments& arguments,
                                      const PrintFrame& frame, float shift_px, const Session& session);

/// The frame for a photograph whose file has these notes. Where the day is not known, the caption has nothing in its
/// place, nor a comma beside it.
PrintFrame print_frame_from(const PrintArguments& arguments, const PictureNotes& notes,
                            const std::filesystem::path& file);

}  // namespace wheatstone::cli
