#include "wheatstone/video/film_layout.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "wheatstone/video/film_layout_internal.h"

namespace wheatstone {
namespace {

using A = Arrangement;
using L = FilmLayout;

// In the order of the enumeration.
constexpr LayoutTraits table[] = {
    {L::mono, "mono", "ml", A::whole, false, false, "mono"},
    {L::left_right, "left-right", "sbsl", A::side_by_side, false, false, "left_right"},
    {L::left_right_half, "left-right-half", "sbs2l", A::side_by_side, false, true, "left_right"},
    {L::right_left, "right-left", "sbsr", A::side_by_side, true, false, "right_left"},
    {L::right_left_half, "right-left-half", "sbs2r", A::side_by_side, true, true, "right_left"},
    {L::top_bottom, "top-bottom", "abl", A::over_under, false, false, "top_bottom"},
    {L::top_bottom_half, "top-bottom-half", "ab2l", A::over_under, false, true, "top_bottom"},
    {L::bottom_top, "bottom-top", "abr", A::over_under, true, false, "bottom_top"},
    {L::bottom_top_half, "bottom-top-half", "ab2r", A::over_under, true, true, "bottom_top"},
    {L::even_odd_rows, "even-odd-rows", "irl", A::rows, false, true, "row_interleaved_lr"},
    {L::odd_even_rows, "odd-even-rows", "irr", A::rows, true, true, "row_interleaved_rl"},
    {L::even_odd_columns, "even-odd-columns", "icl", A::columns, false, true, "col_interleaved_lr"},
    {L::odd_even_columns, "odd-even-columns", "icr", A::columns, true, true, "col_interleaved_rl"},
    {L::checkerboard, "checkerboard", "chl", A::checkerboard, false, true, "checkerboard_lr"},
    {L::checkerboard_right_first, "checkerboard-right-first", "chr", A::checkerboard, true, true, "checkerboard_rl"},
    {L::alternating, "alternating", "al", A::in_time, false, false, "block_lr"},
    {L::alternating_right_first, "alternating-right-first", "ar", A::in_time, true, false, "block_rl"},
};

/// What players and editors call the usual ones.
constexpr std::pair<std::string_view, FilmLayout> short_names[] = {
    {"sbs", L::left_right}, {"sbs-half", L::left_right_half}, {"tb", L::top_bottom}, {"tb-half", L::top_bottom_half}};

}  // namespace

std::span<const LayoutTraits> all_layouts() { return table; }

const LayoutTraits& traits_of(FilmLayout layout) { return table[static_cast<std::size_t>(layout)]; }

FilmLayout layout_with(Arrangement arrangement, bool right_first, bool half) {
  // Only what lies side by side or one above the other comes in two sizes.
  const bool two_sizes = arrangement == A::side_by_side || arrangement == A::over_under;
  const LayoutTraits* found = std::ranges::find_if(table, [&](const LayoutTraits& traits) {
    return traits.arrangement == arrangement && traits.right_first == right_first &&
           (!two_sizes || traits.half == half);
  });
  return found == std::end(table) ? L::mono : found->layout;
}

const char* name_of(FilmLayout layout) { return traits_of(layout).name; }

std::optional<FilmLayout> film_layout_named(std::string_view name) {
  for (const LayoutTraits& traits : table) {
    if (name == traits.name || name == traits.ffmpeg) return traits.layout;
  }
  for (const auto& [short_name, layout] : short_names)
    if (name == short_name) return layout;
  return {};
}

std::string film_layout_names() {
  std::string names;
  for (const LayoutTraits& traits : table) {
    names += fmt::format("{}{} ({})", names.empty() ? "" : ", ", traits.name, traits.ffmpeg);
  }
  names += "; or short";
  for (const auto& [short_name, layout] : short_names) names += fmt::format(" {}", short_name);
  return names;
}

}  // namespace wheatstone
