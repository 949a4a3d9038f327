#include "wheatstone/photograph/find_layout.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "wheatstone/matching/block_agreement.h"
#include "wheatstone/matching/eye_order.h"

namespace wheatstone {
namespace {

/// What a word at the end of a name means.
enum class WordKind { layout, half_layout, full_layout, half, full, nothing_new };
struct Word {
  std::string_view word;
  WordKind kind;
  StereoLayout layout = StereoLayout::left_right;
};

constexpr Word words[] = {
    {"sbs", WordKind::layout, StereoLayout::left_right},
    {"sidebyside", WordKind::layout, StereoLayout::left_right},
    {"parallel", WordKind::layout, StereoLayout::left_right},
    {"lr", WordKind::layout, StereoLayout::left_right},
    {"rl", WordKind::layout, StereoLayout::right_left},
    {"crosseyed", WordKind::layout, StereoLayout::right_left},
    {"crosseye", WordKind::layout, StereoLayout::right_left},
    {"crossview", WordKind::layout, StereoLayout::right_left},
    {"tb", WordKind::layout, StereoLayout::top_bottom},
    {"tab", WordKind::layout, StereoLayout::top_bottom},
    {"ou", WordKind::layout, StereoLayout::top_bottom},
    {"ab", WordKind::layout, StereoLayout::top_bottom},
    {"overunder", WordKind::layout, StereoLayout::top_bottom},
    {"topbottom", WordKind::layout, StereoLayout::top_bottom},
    {"bt", WordKind::layout, StereoLayout::bottom_top},
    {"hsbs", WordKind::half_layout, StereoLayout::left_right},
    {"lrh", WordKind::half_layout, StereoLayout::left_right},
    {"lrq", WordKind::half_layout, StereoLayout::left_right},
    {"rlh", WordKind::half_layout, StereoLayout::right_left},
    {"rlq", WordKind::half_layout, StereoLayout::right_left},
    {"htb", WordKind::half_layout, StereoLayout::top_bottom},
    {"htab", WordKind::half_layout, StereoLayout::top_bottom},
    {"hou", WordKind::half_layout, StereoLayout::top_bottom},
    {"tbh", WordKind::half_layout, StereoLayout::top_bottom},
    {"tbq", WordKind::half_layout, StereoLayout::top_bottom},
    {"bth", WordKind::half_layout, StereoLayout::bottom_top},
    {"btq", WordKind::half_layout, StereoLayout::bottom_top},
    {"lrf", WordKind::full_layout, StereoLayout::left_right},
    {"fsbs", WordKind::full_layout, StereoLayout::left_right},
    {"rlf", WordKind::full_layout, StereoLayout::right_left},
    {"tbf", WordKind::full_layout, StereoLayout::top_bottom},
    {"half", WordKind::half},
    {"h", WordKind::half},
    {"full", WordKind::full},
    {"f", WordKind::full},
    {"3d", WordKind::nothing_new},
    {"180", WordKind::nothing_new},
    {"360", WordKind::nothing_new},
    {"vr", WordKind::nothing_new},
};

/// The words of a name in small letters: what stands between its spaces, dots, dashes and underscores.
std::vector<std::string> words_of(const std::string& name) {
  std::vector<std::string> found(1);
  for (const char letter : name) {
    if (std::isalnum(static_cast<unsigned char>(letter)) != 0) {
      found.back() += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
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

std::optional<StereoLayout> layout_from_name(const std::filesystem::path& path, int width, int height) {
  const std::vector<std::string> name = words_of(path.stem().string());
  std::optional<StereoLayout> layout;
  std::optional<bool> half;
  // Only the last words: elsewhere "ou" and "ab" are words like others.
  for (std::size_t i = name.size(); i-- > 0;) {
    const auto* known =
        std::find_if(std::begin(words), std::end(words), [&](const Word& w) { return w.word == name[i]; });
    if (known == std::end(words)) break;
    switch (known->kind) {
      case WordKind::half_layout:
      case WordKind::full_layout:
        if (!half) half = known->kind == WordKind::half_layout;
        [[fallthrough]];
      case WordKind::layout:
        // What stands first is more exact: "RL_SBS".
        layout = known->layout;
        break;
      case WordKind::half:
      case WordKind::full:
        if (!half) half = known->kind == WordKind::half;
        break;
      case WordKind::nothing_new:
        break;
    }
  }
  if (!layout) return {};
  return half ? with_half_size(*layout, *half) : with_likely_size(*layout, width, height);
}

std::optional<StereoLayout> layout_from_halves(ImageView<const Rgb8> picture) {
  // Pairs agree in over half of their blocks; the halves of one photograph in a fiftieth, of a chessboard in a ninth.
  constexpr double least_share = 0.25;
  constexpr int least_blocks = 12;
  const int half_width = picture.width() / 2, half_height = picture.height() / 2;
  if (half_width == 0 || half_height == 0) return {};
  const auto part = [&](int x, int y, int width, int height) {
    return ImageView<const Rgb8>(&picture(x, y), width, height, picture.stride());
  };
  const BlockAgreement sideways = block_agreement(part(0, 0, half_width, picture.height()),
                                                  part(picture.width() - half_width, 0, half_width, picture.height()));
  const BlockAgreement above = block_agreement(part(0, 0, picture.width(), half_height),
                                               part(0, picture.height() - half_height, picture.width(), half_height));
  const bool side_by_side = sideways.share >= above.share;
  const BlockAgreement& better = side_by_side ? sideways : above;
  const BlockAgreement& worse = side_by_side ? above : sideways;
  if (better.blocks < least_blocks || better.share < least_share || worse.share > better.share / 2) return {};

  const StereoLayout layout = with_likely_size(side_by_side ? StereoLayout::left_right : StereoLayout::top_bottom,
                                               picture.width(), picture.height());
  const bool even = (side_by_side ? picture.width() : picture.height()) % 2 == 0;
  return even && eyes_look_swapped(cut_apart(picture, layout, "")) ? with_eyes_swapped(layout) : layout;
}

bool looks_half_size(bool side_by_side, int width, int height) {
  const double shape = static_cast<double>(width) / height;
  constexpr double film = 16.0 / 9, tolerance = 0.02, widest_view = 2.4;
  if (side_by_side) return std::abs(shape / film - 1) < tolerance;
  return 2 * shape > widest_view;
}

}  // namespace wheatstone
