#include "wheatstone/stereo/stereo_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace wheatstone {
namespace {

using A = Arrangement;
using L = StereoLayout;

// clang-format off
constexpr LayoutTraits table[] = {
    {L::mono, "mono", A::whole, false, false, "ml", "mono",
     "one eye", "2d", ""},
    {L::left_right, "left-right", A::side_by_side, false, false, "sbsl", "left_right",
     "side by side, left eye left", "sbs sidebyside parallel lr", "lrf fsbs"},
    {L::left_right_half, "left-right-half", A::side_by_side, false, true, "sbs2l", "left_right",
     "side by side, left eye left, half width", "hsbs sbshalf lrh lrq", ""},
    {L::right_left, "right-left", A::side_by_side, true, false, "sbsr", "right_left",
     "side by side, right eye left", "crosseyed crosseye crossview rl", "rlf"},
    {L::right_left_half, "right-left-half", A::side_by_side, true, true, "sbs2r", "right_left",
     "side by side, right eye left, half width", "rlh rlq", ""},
    {L::top_bottom, "top-bottom", A::over_under, false, false, "abl", "top_bottom",
     "one above the other, left eye above", "tb tab ou ab overunder topbottom", "tbf"},
    {L::top_bottom_half, "top-bottom-half", A::over_under, false, true, "ab2l", "top_bottom",
     "one above the other, left eye above, half height", "htb htab hou tbhalf tbh tbq", ""},
    {L::bottom_top, "bottom-top", A::over_under, true, false, "abr", "bottom_top",
     "one above the other, right eye above", "bt", ""},
    {L::bottom_top_half, "bottom-top-half", A::over_under, true, true, "ab2r", "bottom_top",
     "one above the other, right eye above, half height", "bth btq", ""},
    {L::even_odd_rows, "even-odd-rows", A::rows, false, true, "irl", "row_interleaved_lr",
     "row by row, left eye in the even rows", "rowinterleaved", ""},
    {L::odd_even_rows, "odd-even-rows", A::rows, true, true, "irr", "row_interleaved_rl",
     "row by row, right eye in the even rows", "", ""},
    {L::even_odd_columns, "even-odd-columns", A::columns, false, true, "icl", "col_interleaved_lr",
     "column by column, left eye in the even columns", "columninterleaved", ""},
    {L::odd_even_columns, "odd-even-columns", A::columns, true, true, "icr", "col_interleaved_rl",
     "column by column, right eye in the even columns", "", ""},
    {L::checkerboard, "checkerboard", A::checkerboard, false, true, "chl", "checkerboard_lr",
     "as a checkerboard, left eye first", "", ""},
    {L::checkerboard_right_first, "checkerboard-right-first", A::checkerboard, true, true, "chr", "checkerboard_rl",
     "as a checkerboard, right eye first", "", ""},
    {L::alternating, "alternating", A::in_time, false, false, "al", "block_lr",
     "one frame after the other, left eye first", "framesequential", ""},
    {L::alternating_right_first, "alternating-right-first", A::in_time, true, false, "ar", "block_rl",
     "one frame after the other, right eye first", "", ""},
};
// clang-format on

constexpr bool in_one_picture(Arrangement arrangement) { return arrangement != A::whole && arrangement != A::in_time; }

constexpr auto packed_names = [] {
  std::array<std::string_view, std::ranges::count_if(table, in_one_picture, &LayoutTraits::arrangement)> names;
  auto* next = names.begin();
  for (const LayoutTraits& traits : table)
    if (in_one_picture(traits.arrangement)) *next++ = traits.name;
  return names;
}();

/// Only what lies side by side or one above the other comes in two sizes.
bool has_two_sizes(Arrangement arrangement) { return arrangement == A::side_by_side || arrangement == A::over_under; }

}  // namespace

std::span<const LayoutTraits> stereo_layouts() { return table; }

const LayoutTraits& traits_of(StereoLayout layout) { return table[static_cast<std::size_t>(layout)]; }

StereoLayout layout_with(Arrangement arrangement, bool right_first, bool half) {
  const LayoutTraits* found = std::ranges::find_if(table, [&](const LayoutTraits& traits) {
    return traits.arrangement == arrangement && traits.right_first == right_first &&
           (!has_two_sizes(arrangement) || traits.half == half);
  });
  return found == std::end(table) ? L::mono : found->layout;
}

std::string_view layout_name(StereoLayout layout) { return traits_of(layout).name; }

bool is_among(std::string_view aliases, std::string_view word) {
  while (!word.empty() && !aliases.empty()) {
    const std::size_t end = std::min(aliases.find(' '), aliases.size());
    if (aliases.substr(0, end) == word) return true;
    aliases.remove_prefix(std::min(end + 1, aliases.size()));
  }
  return false;
}

std::optional<StereoLayout> find_stereo_layout(std::string_view name) {
  std::string word(name);
  std::erase(word, '-');
  for (const LayoutTraits& traits : table) {
    if (name == traits.name || name == traits.ffmpeg) return traits.layout;
    if (is_among(traits.aliases, word) || is_among(traits.full_aliases, word)) return traits.layout;
  }
  return {};
}

std::string stereo_layout_names() {
  std::string names;
  for (const LayoutTraits& traits : table)
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", traits.name, traits.ffmpeg);
  return names;
}

bool is_packed(StereoLayout layout) { return in_one_picture(traits_of(layout).arrangement); }

std::span<const std::string_view> layout_names() { return packed_names; }

StereoLayout with_eyes_swapped(StereoLayout layout) {
  const LayoutTraits& of = traits_of(layout);
  return layout_with(of.arrangement, !of.right_first, of.half);
}

StereoLayout with_half_size(StereoLayout layout, bool half) {
  const LayoutTraits& of = traits_of(layout);
  return layout_with(of.arrangement, of.right_first, half);
}

bool is_half_size(StereoLayout layout) { return traits_of(layout).half; }
bool is_side_by_side(StereoLayout layout) { return traits_of(layout).arrangement == A::side_by_side; }
bool is_left_first(StereoLayout layout) { return !traits_of(layout).right_first; }

}  // namespace wheatstone
