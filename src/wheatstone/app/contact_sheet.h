#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A picture of a contact sheet, and what stands under it.
struct SheetEntry {
  std::filesystem::path picture;
  std::string caption;
};

/// Small pictures in rows, in their order, each with its caption, on white: one page that shows many results. Pictures
/// are read one at a time. Throws as read_image does.
Image<Rgb8> contact_sheet(std::span<const SheetEntry> entries);

}  // namespace wheatstone
