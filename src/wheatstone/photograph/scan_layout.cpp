#include "wheatstone/photograph/scan_layout.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <iterator>

namespace wheatstone {
namespace {

using L = ScanLayout;

constexpr ScanTraits table[] = {
    {L::card, "card", "two photographs on a mount", "", ""},
    {L::anaglyph_red_cyan, "anaglyph-red-cyan", "an anaglyph for red-cyan glasses", "r", "gb"},
    {L::anaglyph_green_magenta, "anaglyph-green-magenta", "an anaglyph for green-magenta glasses", "g", "rb"},
    {L::anaglyph_amber_blue, "anaglyph-amber-blue", "an anaglyph for amber-blue glasses", "rg", "b"},
    {L::anaglyph_red_green, "anaglyph-red-green", "an anaglyph for red-green glasses", "r", "g"},
    {L::anaglyph_red_blue, "anaglyph-red-blue", "an anaglyph for red-blue glasses", "r", "b"},
};

std::uint8_t mean_of(Rgb8 colour, std::string_view channels) {
  int sum = 0;
  for (const char channel : channels) sum += channel == 'r' ? colour.r : channel == 'g' ? colour.g : colour.b;
  const int count = static_cast<int>(channels.size());
  return static_cast<std::uint8_t>((sum + count / 2) / count);
}

}  // namespace

std::span<const ScanTraits> scan_layouts() { return table; }

const ScanTraits& traits_of(ScanLayout layout) { return table[static_cast<std::size_t>(layout)]; }

std::optional<ScanLayout> find_scan_layout(std::string_view name) {
  const ScanTraits* found = std::ranges::find(table, name, &ScanTraits::name);
  return found == std::end(table) ? std::nullopt : std::optional(found->layout);
}

StereoPair separate_anaglyph(ImageView<const Rgb8> picture, ScanLayout layout) {
  const ScanTraits& of = traits_of(layout);
  StereoPair pair{Image<Rgb8>(picture.width(), picture.height()), Image<Rgb8>(picture.width(), picture.height())};
  tbb::parallel_for(0, picture.height(), [&](int y) {
    for (int x = 0; x < picture.width(); ++x) {
      const std::uint8_t left = mean_of(picture(x, y), of.left), right = mean_of(picture(x, y), of.right);
      pair.left(x, y) = {left, left, left};
      pair.right(x, y) = {right, right, right};
    }
  });
  return pair;
}

}  // namespace wheatstone
