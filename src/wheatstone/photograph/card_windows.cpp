#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <tuple>
#include <utility>
#include <vector>

#include "wheatstone/image/mat_opencv.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/photograph/card_windows_internal.h"

namespace wheatstone {
namespace {

/// Lengths are shares of this copy's width.
constexpr int searched_width_px = 900;
constexpr double least_turn_deg = 0.05;

/// A span of rows or columns, `end` excluded.
struct Span {
  int begin = 0, end = 0;
  int size() const { return end - begin; }
};

struct Box {
  Span columns, rows;
};

float median_of(std::vector<float> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::ranges::nth_element(values, middle);
  return *middle;
}

// ---- what is unlike the mount

/// The pixels along the picture's border, as a mask.
cv::Mat border_of(const cv::Size& size) {
  cv::Mat border(size, CV_8U, cv::Scalar(255));
  const int width = std::max(2, size.width / 50);
  border(cv::Rect(width, width, size.width - 2 * width, size.height - 2 * width)).setTo(0);
  return border;
}

/// The mount's colour all over the picture: a plane a channel, fitted to the border, without what lies far from it.
cv::Mat mount_of(const cv::Mat& picture, const cv::Mat& border) {
  std::vector<cv::Point> places;
  cv::findNonZero(border, places);
  std::erase_if(places, [](const cv::Point& at) { return (at.x + at.y) % 4 != 0; });  // enough, and quick
  cv::Mat basis(static_cast<int>(places.size()), 3, CV_32F), values(static_cast<int>(places.size()), 3, CV_32F);
  for (int i = 0; i < basis.rows; ++i) {
    const cv::Point at = places[i];
    basis.at<float>(i, 0) = 1;
    basis.at<float>(i, 1) = static_cast<float>(at.x) / static_cast<float>(picture.cols) - 0.5f;
    basis.at<float>(i, 2) = static_cast<float>(at.y) / static_cast<float>(picture.rows) - 0.5f;
    for (int c = 0; c < 3; ++c) values.at<float>(i, c) = picture.at<cv::Vec3f>(at)[c];
  }
  cv::Mat planes;
  constexpr int rounds = 4;
  for (int round = 0; round < rounds; ++round) {
    cv::solve(basis, values, planes, cv::DECOMP_NORMAL);
    const cv::Mat off = cv::abs(values - basis * planes);
    std::vector<float> distances(static_cast<std::size_t>(basis.rows));
    for (int i = 0; i < basis.rows; ++i) distances[i] = off.at<float>(i, 0) + off.at<float>(i, 1) + off.at<float>(i, 2);
    const float most = 3 * median_of(distances) + 1e-3f;
    for (int i = 0; i < basis.rows; ++i) {
      // What lies off counts for nothing from here on.
      for (int c = 0; c < 3 && distances[i] > most; ++c) basis.at<float>(i, c) = values.at<float>(i, c) = 0;
    }
  }
  const auto coefficients = [&](int i) {
    return cv::Vec3f(planes.at<float>(i, 0), planes.at<float>(i, 1), planes.at<float>(i, 2));
  };
  const cv::Vec3f level = coefficients(0), along = coefficients(1), down = coefficients(2);
  cv::Mat mount(picture.size(), CV_32FC3);
  for (int y = 0; y < mount.rows; ++y) {
    const cv::Vec3f of_row = level + down * (static_cast<float>(y) / static_cast<float>(picture.rows) - 0.5f);
    auto* row = mount.ptr<cv::Vec3f>(y);
    for (int x = 0; x < mount.cols; ++x)
      row[x] = of_row + along * (static_cast<float>(x) / static_cast<float>(picture.cols) - 0.5f);
  }
  return mount;
}

/// 1 where the picture is unlike the mount, else 0; empty where the border is of no one colour.
cv::Mat unlike_mount(const cv::Mat& picture) {
  const cv::Mat border = border_of(picture.size());
  cv::Mat off;
  cv::absdiff(picture, mount_of(picture, border), off);
  cv::Mat channels[3], distance;
  cv::split(off, channels);
  distance = (channels[0] + channels[1] + channels[2]) / 3;
  std::vector<cv::Point> places;
  cv::findNonZero(border, places);
  std::vector<float> of_border;
  for (const cv::Point& at : places) of_border.push_back(distance.at<float>(at));
  const float grain = median_of(of_border);
  constexpr float most_grain = 8, least_step = 3;
  if (grain > most_grain) return {};
  return (distance > std::max(5 * grain, least_step)) / 255;
}

// ---- blocks in profiles

/// For each column (`along` 0) or row (1) of a box, which share of it is unlike the mount.
std::vector<float> profile_of(const cv::Mat& mask, const Box& box, int along) {
  cv::Mat sums;
  const cv::Mat part = mask(cv::Range(box.rows.begin, box.rows.end), cv::Range(box.columns.begin, box.columns.end));
  cv::reduce(part, sums, along, cv::REDUCE_SUM, CV_32F);
  std::vector<float> profile(sums.begin<float>(), sums.end<float>());
  const auto length = static_cast<float>(along == 0 ? box.rows.size() : box.columns.size());
  for (float& sum : profile) sum /= length;
  return profile;
}

/// The span about `from` in which a profile is above a level; shorter gaps than `gap` are passed over.
Span block_about(const std::vector<float>& profile, int from, float level, int gap) {
  const auto reach = [&](int step) {
    int last = from;
    for (int i = from; i >= 0 && i < static_cast<int>(profile.size()) && std::abs(i - last) <= gap; i += step)
      if (profile[i] > level) last = i;
    return last;
  };
  return {reach(-1), reach(1) + 1};
}

/// The longest span in which a profile is above a level, but for short gaps.
Span longest_block(const std::vector<float>& profile, float level, int gap) {
  Span longest;
  for (int i = 0; i < static_cast<int>(profile.size()); ++i) {
    if (profile[i] <= level) continue;
    const Span block = block_about(profile, i, level, gap);
    if (block.size() > longest.size()) longest = block;
    i = block.end;
  }
  return longest;
}

/// The widest bare span about the middle.
Span gutter_of(const std::vector<float>& profile, float level) {
  const int width = static_cast<int>(profile.size());
  Span widest;
  for (int i = width * 38 / 100; i < width * 62 / 100; ++i) {
    Span bare{i, i};
    while (bare.end < width && profile[bare.end] <= level) ++bare.end;
    if (bare.size() > widest.size()) widest = bare;
    i = bare.end;
  }
  return widest;
}

constexpr float bare_share = 0.08f;  ///< of a column or row beside the photographs, at most

/// One photograph: its columns among `columns`, then its rows, then its columns once more.
Box window_among(const cv::Mat& mask, const Span& columns, const Span& rows) {
  if (columns.size() <= 1) return {};
  const int column_gap = mask.cols * 15 / 1000, row_gap = std::max(mask.cols / 100, 1);
  Box box{columns, rows};
  for (int round = 0; round < 2; ++round) {
    const Span found = longest_block(profile_of(mask, {columns, box.rows}, 0), 2 * bare_share, column_gap);
    box.columns = {columns.begin + found.begin, columns.begin + found.end};
    if (box.columns.size() <= 0) return {};
    const std::vector<float> by_row = profile_of(mask, {box.columns, {0, mask.rows}}, 1);
    box.rows = block_about(by_row, (rows.begin + rows.end) / 2, 2 * bare_share, row_gap);
    if (box.rows.size() <= 1) return {};
  }
  return box;
}

bool are_alike(const Box& left, const Box& right, const cv::Size& card) {
  const auto near = [](int a, int b, double most) { return std::abs(a - b) <= most; };
  const double width = std::min(left.columns.size(), right.columns.size());
  const double height = std::min(left.rows.size(), right.rows.size());
  constexpr double least_width = 0.22, least_height = 0.15, unlike_size = 0.12, off_middle = 0.08;
  if (width < least_width * card.width || height < least_height * card.width) return false;
  if (!near(left.columns.size(), right.columns.size(), unlike_size * width)) return false;
  if (!near(left.rows.size(), right.rows.size(), unlike_size * height)) return false;
  if (!near(left.rows.begin, right.rows.begin, unlike_size * height)) return false;
  return near(left.columns.begin, card.width - right.columns.end, off_middle * card.width);
}

/// Whether the photographs cover their windows, and the rest of the card is bare.
bool are_on_a_mount(const cv::Mat& mask, const Box& left, const Box& right) {
  const auto count = [&](const Box& box) {
    return cv::countNonZero(
        mask(cv::Range(box.rows.begin, box.rows.end), cv::Range(box.columns.begin, box.columns.end)));
  };
  const auto area = [](const Box& box) { return static_cast<double>(box.columns.size()) * box.rows.size(); };
  const double within = count(left) + count(right), windows = area(left) + area(right);
  const double beside = cv::countNonZero(mask) - within, rest = static_cast<double>(mask.total()) - windows;
  constexpr double least_covered = 0.5, most_written = 0.2;
  return within >= least_covered * windows && beside <= most_written * rest;
}

/// Both photographs of a card that lies straight.
struct Boxes {
  Box left, right;
};

/// `touch`: there is no mount between them; they are taken to be equally wide.
std::optional<Boxes> find_boxes(const cv::Mat& mask, bool touch) {
  if (mask.empty()) return {};
  const Box all{{0, mask.cols}, {0, mask.rows}};
  constexpr float photograph_share = 0.25f;  // of a row through both; writing covers less
  const Span rows = longest_block(profile_of(mask, all, 1), photograph_share, mask.cols / 30);
  if (rows.size() <= 0) return {};
  const std::vector<float> profile = profile_of(mask, {all.columns, rows}, 0);
  Span gutter = gutter_of(profile, bare_share);
  if (touch != (gutter.size() <= 0)) return {};
  if (touch) {
    const Span both = longest_block(profile, 2 * bare_share, mask.cols * 15 / 1000);
    gutter.begin = gutter.end = (both.begin + both.end) / 2;
  }
  const Boxes boxes{window_among(mask, {0, gutter.begin}, rows), window_among(mask, {gutter.end, mask.cols}, rows)};
  if (!are_alike(boxes.left, boxes.right, mask.size()) || !are_on_a_mount(mask, boxes.left, boxes.right)) return {};
  return boxes;
}

/// Of a picture that shows more than the card, before a ground of one colour, the part that is card for certain.
Box card_within(const cv::Mat& picture) {
  const cv::Mat mask = unlike_mount(picture);
  if (mask.empty()) return {};
  const Box all{{0, mask.cols}, {0, mask.rows}};
  const auto span = [&](int along) {
    const std::vector<float> profile = profile_of(mask, all, along);
    const Span found = longest_block(profile, 0.8f * std::ranges::max(profile), mask.cols / 100);
    const int inset = mask.cols / 100;
    return Span{found.begin + inset, found.end - inset};
  };
  const Box card{span(0), span(1)};
  constexpr int least_side_px = 64;
  return card.columns.size() < least_side_px || card.rows.size() < least_side_px ? Box{} : card;
}

// ---- how far the card is turned

cv::Mat straightened(const cv::Mat& picture, double turn_deg, int interpolation) {
  if (turn_deg == 0) return picture;
  const cv::Point2f centre(static_cast<float>(picture.cols - 1) / 2, static_cast<float>(picture.rows - 1) / 2);
  cv::Mat turned;
  // OpenCV counts angles against the clock.
  cv::warpAffine(picture, turned, cv::getRotationMatrix2D(centre, turn_deg, 1), picture.size(), interpolation,
                 cv::BORDER_REPLICATE);
  return turned;
}

/// How sharply rows and columns change from one to the next: most where the photographs' edges run along them.
double sharpness_of(const cv::Mat& mask) {
  double sum = 0;
  const Box all{{0, mask.cols}, {0, mask.rows}};
  for (const int along : {0, 1}) {
    const std::vector<float> profile = profile_of(mask, all, along);
    for (std::size_t i = 1; i < profile.size(); ++i)
      sum += (profile[i] - profile[i - 1]) * (profile[i] - profile[i - 1]);
  }
  return sum;
}

/// By how much the card is turned clockwise: where its mask, straightened, is sharpest.
double turn_of(const cv::Mat& mask) {
  constexpr double most_turn_deg = 3, coarse_step_deg = 0.25, fine_step_deg = 0.05;
  cv::Mat smooth;
  mask.convertTo(smooth, CV_32F);
  smooth = shrunk(smooth, 0.5);
  // As smooth as turning makes it: else not to turn at all would always be sharpest.
  cv::GaussianBlur(smooth, smooth, {}, 0.8);
  double best_turn = 0, best = -1;
  const auto search = [&](double from, double to, double step) {
    const int steps = static_cast<int>(std::lround((to - from) / step));
    for (int i = 0; i <= steps; ++i) {
      const double turn = from + i * step, sharpness = sharpness_of(straightened(smooth, turn, cv::INTER_LINEAR));
      if (sharpness > best) std::tie(best, best_turn) = std::pair{sharpness, turn};
    }
  };
  search(-most_turn_deg, most_turn_deg, coarse_step_deg);
  search(best_turn - coarse_step_deg, best_turn + coarse_step_deg, fine_step_deg);
  return std::abs(best_turn) < least_turn_deg ? 0 : best_turn;
}

/// Both windows cut to one size, about their middles, in pixels of the whole picture. The blurred edges of the
/// photographs, which reach out over the mount, are left out.
CardWindows of_one_size(const Boxes& boxes, double turn_deg, double scale) {
  const auto& [left, right] = boxes;
  constexpr int edge_px = 2;
  const auto side = [&](const Span& a, const Span& b) {
    return static_cast<int>((std::min(a.size(), b.size()) - 2 * edge_px) * scale);
  };
  const int width = side(left.columns, right.columns), height = side(left.rows, right.rows);
  const auto place = [&](const Box& box) {
    const auto begin = [&](const Span& span, int size) {
      return std::max(0, static_cast<int>(std::lround((span.begin + span.end) * scale / 2 - size / 2.)));
    };
    return CardWindow{begin(box.columns, width), begin(box.rows, height), width, height};
  };
  return {{}, turn_deg, place(left), place(right)};
}

/// A part of the small copy in pixels of the whole picture.
CardWindow whole_pixels(const Box& part, double scale, const cv::Size& most) {
  const auto whole = [&](int length, int most_length) {
    return std::min(static_cast<int>(std::lround(length * scale)), most_length);
  };
  const int left = whole(part.columns.begin, most.width), top = whole(part.rows.begin, most.height);
  return {left, top, whole(part.columns.end, most.width) - left, whole(part.rows.end, most.height) - top};
}

struct Straightened {
  Boxes boxes;
  double turn_deg;
};

std::optional<Straightened> find_straightened(const cv::Mat& card, bool touch) {
  const cv::Mat as_it_lies = unlike_mount(card);
  if (as_it_lies.empty()) return {};
  const double turn_deg = turn_of(as_it_lies);
  const auto boxes = find_boxes(unlike_mount(straightened(card, turn_deg, cv::INTER_LINEAR)), touch);
  if (!boxes) return {};
  return Straightened{*boxes, turn_deg};
}

/// What is one photograph on a mount has two halves, too.
bool shows_one_scene_twice(ImageView<const Rgb8> picture, const CardWindows& windows) {
  constexpr double least_share = 0.25;
  const StereoPair halves = cut_card(picture, windows);
  return block_agreement(halves.left, halves.right, least_share).share >= least_share;
}

}  // namespace

std::optional<CardWindows> find_card_windows(ImageView<const Rgb8> picture) {
  constexpr int least_side_px = 64;
  if (picture.width() < least_side_px || picture.height() < least_side_px) return {};
  const double scale = std::max(static_cast<double>(picture.width()) / searched_width_px, 1.0);
  const cv::Size size(static_cast<int>(picture.width() / scale), static_cast<int>(picture.height() / scale));
  constexpr int least_rows = 16;  // of a strip that is flatter, no card is told
  if (size.height < least_rows) return {};
  cv::Mat small;
  cv::resize(as_mat(picture), small, size, 0, 0, cv::INTER_AREA);
  small.convertTo(small, CV_32FC3);
  constexpr double grain_px = 1.2;
  cv::GaussianBlur(small, small, {}, grain_px);

  // The whole picture may be card, or a part of it. That the photographs touch is believed last: the halves of a whole
  // card before its ground look alike, too.
  const Box all{{0, small.cols}, {0, small.rows}}, within = card_within(small);
  for (const bool touch : {false, true}) {
    for (const Box& part : touch ? std::array{within, all} : std::array{all, within}) {
      if (part.columns.size() <= 0) continue;
      const auto found = find_straightened(
          small(cv::Range(part.rows.begin, part.rows.end), cv::Range(part.columns.begin, part.columns.end)), touch);
      if (!found) continue;
      CardWindows windows = of_one_size(found->boxes, found->turn_deg, scale);
      windows.card = whole_pixels(part, scale, {picture.width(), picture.height()});
      if (!touch || shows_one_scene_twice(picture, windows)) return windows;
    }
  }
  return {};
}

StereoPair cut_card(ImageView<const Rgb8> picture, const CardWindows& windows) {
  const CardWindow& card = windows.card;
  const cv::Mat straight = straightened(as_mat(picture)(cv::Rect(card.left, card.top, card.width, card.height)),
                                        windows.turn_deg, cv::INTER_CUBIC);
  const auto part = [&](const CardWindow& window) {
    Image<Rgb8> view(window.width, window.height);
    cv::Mat target = as_mat(view);
    straight(cv::Rect(window.left, window.top, window.width, window.height)).copyTo(target);
    return view;
  };
  return {part(windows.left), part(windows.right)};
}

std::string describe_card(const CardWindows& windows) {
  const CardWindow& card = windows.card;
  std::string text = fmt::format("windows of {}x{} pixels at {},{} and {},{}", windows.left.width, windows.left.height,
                                 card.left + windows.left.left, card.top + windows.left.top,
                                 card.left + windows.right.left, card.top + windows.right.top);
  if (windows.turn_deg != 0) text += fmt::format("; the card is turned by {:.1f} degrees", windows.turn_deg);
  return text;
}

}  // namespace wheatstone
