#include "wheatstone/stereo/stereo_layout.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <opencv2/imgproc.hpp>
#include <utility>

#include "wheatstone/error.h"
#include "wheatstone/image/opencv_internal.h"

namespace wheatstone {
namespace {

struct LayoutFacts {
  StereoLayout layout;
  std::string_view name;
  std::string_view words;
  bool side_by_side, left_first, half;
};

// In the order of the enumeration.
constexpr std::array<LayoutFacts, 8> facts = {{
    {StereoLayout::left_right, "left-right", "side by side, left eye left", true, true, false},
    {StereoLayout::left_right_half, "left-right-half", "side by side, left eye left, half width", true, true, true},
    {StereoLayout::right_left, "right-left", "side by side, right eye left", true, false, false},
    {StereoLayout::right_left_half, "right-left-half", "side by side, right eye left, half width", true, false, true},
    {StereoLayout::top_bottom, "top-bottom", "one above the other, left eye above", false, true, false},
    {StereoLayout::top_bottom_half, "top-bottom-half", "one above the other, left eye above, half height", false, true,
     true},
    {StereoLayout::bottom_top, "bottom-top", "one above the other, right eye above", false, false, false},
    {StereoLayout::bottom_top_half, "bottom-top-half", "one above the other, right eye above, half height", false,
     false, true},
}};

constexpr auto names = [] {
  std::array<std::string_view, facts.size()> all;
  for (std::size_t i = 0; i < facts.size(); ++i) all[i] = facts[i].name;
  return all;
}();

constexpr std::pair<std::string_view, StereoLayout> aliases[] = {
    {"sbs", StereoLayout::left_right},        {"sbsl", StereoLayout::left_right},
    {"parallel", StereoLayout::left_right},   {"lr", StereoLayout::left_right},
    {"hsbs", StereoLayout::left_right_half},  {"sbs2l", StereoLayout::left_right_half},
    {"lrh", StereoLayout::left_right_half},   {"sbsr", StereoLayout::right_left},
    {"cross-eyed", StereoLayout::right_left}, {"rl", StereoLayout::right_left},
    {"sbs2r", StereoLayout::right_left_half}, {"rlh", StereoLayout::right_left_half},
    {"tb", StereoLayout::top_bottom},         {"abl", StereoLayout::top_bottom},
    {"ou", StereoLayout::top_bottom},         {"htb", StereoLayout::top_bottom_half},
    {"hou", StereoLayout::top_bottom_half},   {"ab2l", StereoLayout::top_bottom_half},
    {"tbh", StereoLayout::top_bottom_half},   {"bt", StereoLayout::bottom_top},
    {"abr", StereoLayout::bottom_top},        {"ab2r", StereoLayout::bottom_top_half},
    {"bth", StereoLayout::bottom_top_half},
};

const LayoutFacts& facts_of(StereoLayout layout) { return facts[static_cast<std::size_t>(layout)]; }

StereoLayout layout_with(bool side_by_side, bool left_first, bool half) {
  const auto* found = std::find_if(facts.begin(), facts.end(), [&](const LayoutFacts& layout) {
    return layout.side_by_side == side_by_side && layout.left_first == left_first && layout.half == half;
  });
  return found->layout;
}

/// A part of the picture as an image of its own, stretched to `size`.
Image<Rgb8> part(ImageView<const Rgb8> picture, const cv::Rect& place, const cv::Size& size) {
  const cv::Mat from = as_mat(picture)(place);
  Image<Rgb8> to(size.width, size.height);
  cv::Mat target = as_mat(to);
  if (place.size() == size) {
    from.copyTo(target);
  } else {
    cv::resize(from, target, size, 0, 0, cv::INTER_LANCZOS4);
  }
  return to;
}

}  // namespace

std::string_view layout_name(StereoLayout layout) { return facts_of(layout).name; }
std::string_view layout_words(StereoLayout layout) { return facts_of(layout).words; }
std::span<const std::string_view> layout_names() { return names; }
bool is_half_size(StereoLayout layout) { return facts_of(layout).half; }
bool is_side_by_side(StereoLayout layout) { return facts_of(layout).side_by_side; }
bool is_left_first(StereoLayout layout) { return facts_of(layout).left_first; }

StereoLayout layout_by_name(std::string_view name) {
  for (const LayoutFacts& layout : facts)
    if (layout.name == name) return layout.layout;
  for (const auto& [alias, layout] : aliases)
    if (alias == name) return layout;
  if (name == "anaglyph")
    throw Error(
        ErrorKind::wrong_usage,
        "layout: 'anaglyph' cannot be taken apart: each eye kept only some of its colours; expected the pictures "
        "that it was made from");
  throw Error(ErrorKind::wrong_usage,
              fmt::format("layout: is '{}', expected one of {}", name, fmt::join(layout_names(), ", ")));
}

StereoLayout with_eyes_swapped(StereoLayout layout) {
  const LayoutFacts& of = facts_of(layout);
  return layout_with(of.side_by_side, !of.left_first, of.half);
}

StereoLayout with_half_size(StereoLayout layout, bool half) {
  const LayoutFacts& of = facts_of(layout);
  return layout_with(of.side_by_side, of.left_first, half);
}

StereoPair cut_apart(ImageView<const Rgb8> picture, StereoLayout layout, const std::string& name) {
  const LayoutFacts& of = facts_of(layout);
  const int side = of.side_by_side ? picture.width() : picture.height();
  if (side % 2 != 0 || side == 0)
    throw Error(ErrorKind::bad_input,
                fmt::format("{}: is {}x{} pixels, expected an even {} to hold two pictures {}", name, picture.width(),
                            picture.height(), of.side_by_side ? "width" : "height",
                            of.side_by_side ? "side by side" : "one above the other"));
  cv::Size each(picture.width(), picture.height());
  (of.side_by_side ? each.width : each.height) = side / 2;
  const cv::Point second(of.side_by_side ? side / 2 : 0, of.side_by_side ? 0 : side / 2);
  const cv::Size full = of.half ? cv::Size(picture.width(), picture.height()) : each;
  StereoPair pair{part(picture, {{0, 0}, each}, full), part(picture, {second, each}, full)};
  if (!of.left_first) std::swap(pair.left, pair.right);
  return pair;
}

Image<Rgb8> put_together(ImageView<const Rgb8> left, ImageView<const Rgb8> right, StereoLayout layout) {
  const bool side_by_side = is_side_by_side(layout), half = is_half_size(layout);
  if (!is_left_first(layout)) std::swap(left, right);
  cv::Size each(left.width(), left.height());
  if (half) (side_by_side ? each.width : each.height) = ((side_by_side ? each.width : each.height) + 1) / 2;
  Image<Rgb8> both(side_by_side ? 2 * each.width : each.width, side_by_side ? each.height : 2 * each.height);
  const cv::Mat whole = as_mat(both);
  const cv::Point second(side_by_side ? each.width : 0, side_by_side ? 0 : each.height);
  cv::resize(as_mat(left), whole({{0, 0}, each}), each, 0, 0, cv::INTER_AREA);
  cv::resize(as_mat(right), whole({second, each}), each, 0, 0, cv::INTER_AREA);
  return both;
}

}  // namespace wheatstone
