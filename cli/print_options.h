#pragma once

#include <filesystem>
#include <string>

#include "options.h"
#include "wheatstone/display/print_frame.h"
#include "wheatstone/pictures/picture_notes.h"

namespace wheatstone::cli {

/// What is put around views, and what goes into their files beside them, as it is typed.
struct PrintArguments {
  PrintFrame frame;            ///< without the caption's text
  std::string caption;         ///< with placeholders; empty: none
  bool keep_location = false;  ///< where the photograph was taken
};

/// --crop, --border, --caption and --keep-location. `unless_framed` are reasons against a border and a caption, and
/// `unless_bordered` further ones against a border.
Rows print_rows(PrintArguments& arguments, const Reasons& unless_framed, Reasons unless_bordered);

/// The frame for a photograph whose file has these notes. Where the day is not known, the caption has nothing in its
/// place, nor a comma beside it.
PrintFrame print_frame_from(const PrintArguments& arguments, const PictureNotes& notes,
                            const std::filesystem::path& file);

}  // namespace wheatstone::cli
