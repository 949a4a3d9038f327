#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "wheatstone/image/image.h"

namespace wheatstone {

/// A picture of a contact sheet, and what stands under it; a place without a picture stays white.
struct SheetEntry {
  std::filesystem::path picture;
  std::string caption;
};

struct SheetLayout {
  int columns = 0;  ///< 0: about as many as rows
  int tile_width = 320, tile_height = 240;
};

/// Small pictures in rows, in their order, each with its caption, on white: one page that shows many results. Pictures
/// larger than a tile are reduced to it; they are read one at a time. Throws as read_image does.
Image<Rgb8> contact_sheet(std::span<const SheetEntry> entries, const SheetLayout& layout = {});

}  // namespace wheatstone
