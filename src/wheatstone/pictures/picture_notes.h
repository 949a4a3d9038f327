#pragma once

#include <string>

namespace wheatstone {

/// What a file says of its picture beside the pixels, and what goes with them into other files.
struct PictureNotes {
  std::string title;           ///< UTF-8; empty: none
  std::string taken;           ///< when, as "2019:07:18 14:03:22" (EXIF); empty: not known
  std::string exif;            ///< from the TIFF header on; empty: none
  double pixels_an_inch = 0;   ///< of prints; 0: not said
  std::string colour_profile;  ///< ICC, of the picture's colours; empty: sRGB
};

/// The bytes of a PNG or a JPEG with notes: an EXIF block, the title (PNG), pixels an inch, the colour profile. What is
/// neither of both comes back as it is; a TIFF takes its notes while it is written (write_image).
std::string with_notes(std::string picture, const PictureNotes& notes);

}  // namespace wheatstone
