#pragma once

#include <optional>
#include <span>
#include <string_view>

#include "wheatstone/stereo/stereo_pair.h"

namespace wheatstone {

/// How a scanned or printed picture holds two views, besides the layouts that films have, too (StereoLayout).
enum class ScanLayout {
  card,               ///< two photographs on a mount, the left eye's on the left
  anaglyph_red_cyan,  ///< for coloured glasses: the filter before the left eye comes first
  anaglyph_green_magenta,
  anaglyph_amber_blue,
  anaglyph_red_green,
  anaglyph_red_blue,
};

/// One line of the table of such layouts, from which names, help and words are made.
struct ScanTraits {
  ScanLayout layout;
  std::string_view name;   ///< the enumerator with hyphens
  std::string_view words;  ///< "an anaglyph for red-cyan glasses"
  std::string_view left;   ///< channels that the left eye sees, of "rgb"; empty where both see all
  std::string_view right;
};

/// The table, in the order of the enumeration.
std::span<const ScanTraits> scan_layouts();
const ScanTraits& traits_of(ScanLayout layout);
std::optional<ScanLayout> find_scan_layout(std::string_view name);

/// The two views of an anaglyph, in grey: the mean of the channels that each eye sees.
StereoPair separate_anaglyph(ImageView<const Rgb8> picture, ScanLayout layout);

}  // namespace wheatstone
