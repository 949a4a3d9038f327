#include "wheatstone/photograph/find_layout.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/files/text_encoding.h"
#include "wheatstone/matching/eye_order.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/pictures/picture_file.h"
#include "wheatstone/stereo/packed_pair.h"

namespace wheatstone {
namespace {

/// What a word at the end of a name says.
struct Word {
  bool known = false;
  std::optional<StereoLayout> layout{};
  std::optional<bool> half{};
};

/// Words that say how large the eyes are, and those that stand beside a layout and change nothing.
constexpr std::string_view half_words = "half h", full_words = "full f", idle_words = "3d 180 360 vr";

Word meaning_of(std::string_view word) {
  for (const LayoutTraits& traits : stereo_layouts()) {
    if (traits.arrangement != Arrangement::side_by_side && traits.arrangement != Arrangement::over_under) continue;
    const bool says_full = is_among(traits.full_aliases, word);
    if (!says_full && !is_among(traits.aliases, word)) continue;
    return {true, traits.layout, says_full || traits.half ? std::optional(traits.half) : std::nullopt};
  }
  if (is_among(half_words, word)) return {true, {}, true};
  if (is_among(full_words, word)) return {true, {}, false};
  return {is_among(idle_words, word), {}, {}};
}

/// The words of a name in small letters: what stands between its spaces, dots, dashes and underscores.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> found(1);
  for (const char letter : lower_case(name)) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
      found.back() += letter;
    } else if (!found.back().empty()) {
      found.emplace_back();
    }
  }
  if (found.back().empty()) found.pop_back();
  return found;
}

StereoLayout with_likely_size(StereoLayout layout, int width, int height) {
  return with_half_size(layout, looks_half_size(is_side_by_side(layout), width, height));
}

}  // namespace

bool is_stereo_file_name(const std::filesystem::path& path) {
  constexpr std::array<std::string_view, 3> endings{".mpo", ".jps", ".pns"};
  return std::ranges::find(endings, ending_of(path)) != endings.end();
}

std::optional<StereoLayout> layout_from_name(const std::filesystem::path& path, int width, int height) {
  const std::vector<std::string> name = words_of(path.stem().string());
  std::optional<StereoLayout> layout;
  std::optional<bool> half;
  // Only the last words: elsewhere "ou" and "ab" are words like others.
  for (std::size_t i = name.size(); i-- > 0;) {
    const Word word = meaning_of(name[i]);
    if (!word.known) break;
    // What stands first is more exact: "RL_SBS".
    if (word.layout) layout = word.layout;
    if (!half) half = word.half;
  }
  if (!layout) return {};
  return half ? with_half_size(*layout, *half) : with_likely_size(*layout, width, height);
}

std::optional<Arrangement> arrangement_of_halves(ImageView<const Rgb8> picture) {
  // Pairs agree in over half of their blocks; the halves of one photograph in a fiftieth, of a chessboard in a ninth.
  constexpr double least_share = 0.25, looked_for = least_share / 2;
  constexpr int least_blocks = 12;
  const int half_width = picture.width() / 2, half_height = picture.height() / 2;
  if (half_width == 0 || half_height == 0) return {};
  const auto part = [&](int x, int y, int width, int height) {
    return ImageView<const Rgb8>(&picture(x, y), width, height, picture.stride());
  };
  const BlockAgreement sideways =
      block_agreement(part(0, 0, half_width, picture.height()),
                      part(picture.width() - half_width, 0, half_width, picture.height()), looked_for);
  const BlockAgreement above =
      block_agreement(part(0, 0, picture.width(), half_height),
                      part(0, picture.height() - half_height, picture.width(), half_height), looked_for);
  const bool side_by_side = sideways.share >= above.share;
  const BlockAgreement& better = side_by_side ? sideways : above;
  const BlockAgreement& worse = side_by_side ? above : sideways;
  if (better.blocks < least_blocks || better.share < least_share || worse.share > better.share / 2) return {};
  return side_by_side ? Arrangement::side_by_side : Arrangement::over_under;
}

std::optional<StereoLayout> layout_from_halves(ImageView<const Rgb8> picture) {
  const std::optional<Arrangement> arrangement = arrangement_of_halves(picture);
  if (!arrangement) return {};
  const bool side_by_side = *arrangement == Arrangement::side_by_side;
  const StereoLayout layout = with_likely_size(side_by_side ? StereoLayout::left_right : StereoLayout::top_bottom,
                                               picture.width(), picture.height());
  const std::optional<Image<Rgb8>> even = without_middle(picture, layout);
  const StereoPair halves = cut_apart(even ? ImageView<const Rgb8>(*even) : picture, layout, "");
  return eye_order(halves) == EyeOrder::swapped ? with_eyes_swapped(layout) : layout;
}

bool looks_half_size(bool side_by_side, int width, int height) {
  const double shape = static_cast<double>(width) / height;
  constexpr double film = 16.0 / 9, tolerance = 0.02, widest_view = 2.4;
  if (side_by_side) return std::abs(shape / film - 1) < tolerance;
  return 2 * shape > widest_view;
}

}  // namespace wheatstone
