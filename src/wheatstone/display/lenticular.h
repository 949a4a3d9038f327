#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "wheatstone/depth/display_presets.h"
#include "wheatstone/image/image.h"

namespace wheatstone {

/// A screen under slanted lenses or slits: which of its sub-pixels are seen from where. The numbers are those of a
/// Looking Glass's calibration; a barrier's period and slant are put in the same way.
struct LenticularScreen {
  int width = 1920, height = 1080;  ///< pixels
  double pitch = 50;                ///< lenses an inch, across the lenses
  double slope = 6;                 ///< rows up for one column along the lens; negative leans left, large is upright
  double center = 0;                ///< of the middle view, in lenses
  double dpi = 100;                 ///< pixels an inch
  bool flip = false;                ///< the slant leans the other way
  bool blue_first = false;          ///< sub-pixels from left to right are blue, green, red
  bool first_from_left = false;     ///< under a lens the views lie from left to right, not from right to left
};

/// Which of `views` (1 to 65535) the sub-pixel shows: channel 0, 1, 2 is red, green, blue, pixel (x, y) from the upper
/// left. With u, v in 0..1 from the bottom left, c = 0, 1, 2 from the left: t = height / (width·slope),
/// a = (u + c/(3·width) + v·t)·p − center, p = pitch·width/dpi·cos(atan(1/slope)); the view is ⌊(1 − frac a)·views⌋,
/// or ⌊frac a·views⌋ where the first lies left.
int view_of_subpixel(const LenticularScreen& screen, int views, int x, int y, int channel);

/// The same for a whole row: three a pixel, red, green, blue.
void views_of_row(const LenticularScreen& screen, int views, int y, std::span<std::uint16_t> three_per_pixel);

/// The picture for the screen: each sub-pixel from its view, read at the place on the view where the sub-pixel is on
/// the screen. Views of the screen's size are taken pixel by pixel. Throws Error{wrong_usage} where there is no view,
/// or they are of different sizes.
Image<Rgb8> interleave(std::span<const Image<Rgb8>> views, const LenticularScreen& screen);

/// The same into a picture that is there already, of the screen's size: films need no new one for every frame.
void interleave(std::span<const Image<Rgb8>> views, const LenticularScreen& screen, ImageView<Rgb8> picture);

/// The screen of a display that has lenses. Throws Error{wrong_usage} where the display has none.
LenticularScreen lenticular_screen_of(const DisplayPreset& display);

/// The screen of the display of this name (depth/display_presets.h), as "step-9"; a name that ends in .json is a file,
/// read as a Looking Glass's calibration. Throws Error: wrong_usage that lists the displays with lenses, bad_input for
/// the file.
LenticularScreen find_lenticular(const std::string& name);

/// Throws Error{bad_input} where the file is no JSON or lacks a number. What old files lack (invView, flipImageX,
/// flipSubp) is as on their displays.
LenticularScreen read_calibration(const std::filesystem::path& path);

}  // namespace wheatstone
