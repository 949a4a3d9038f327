#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <ctime>
#include <optional>
#include <utility>

#include "wheatstone/matching/eye_order.h"
#include "wheatstone/matching/match.h"
#include "wheatstone/matching/not_a_pair.h"
#include "wheatstone/photograph/pairs_by_time_internal.h"
#include "wheatstone/photograph/photograph_notes.h"
#include "wheatstone/pictures/read_image.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone {
namespace {

namespace fs = std::filesystem;

constexpr double together_s = 2;
constexpr const char* alone = "one view: it has no second view and no depth";

/// Seconds since some day; none where the file does not say when it was taken.
std::optional<double> time_of(const fs::path& file) {
  std::tm time{};
  const std::string taken = read_photograph_notes(file).taken;
  if (std::sscanf(taken.c_str(), "%d:%d:%d %d:%d:%d", &time.tm_year, &time.tm_mon, &time.tm_mday, &time.tm_hour,
                  &time.tm_min, &time.tm_sec) != 6)
    return {};
  time.tm_year -= 1900;
  time.tm_mon -= 1;
  const std::time_t seconds = ::timegm(&time);
  return seconds == -1 ? std::nullopt : std::optional(static_cast<double>(seconds));
}

struct Taken {
  double time_s = 0;
  fs::path file;
};

/// Why two pictures are no sure pair; empty where they are, then left and right are in their order.
std::string wrong_with(StereoPair pair, bool& is_swapped) {
  const PictureSize left{pair.left.width(), pair.left.height()}, right{pair.right.width(), pair.right.height()};
  if (left != right && !differ_by_few(left, right)) return "has another size";
  frame_common_part(pair);
  constexpr int longest_px = 960;
  const PictureSize size = reduced_size({pair.left.width(), pair.left.height()}, longest_px);
  pair = {reduced(pair.left, size), reduced(pair.right, size)};
  constexpr int least_inliers = 30;
  const PairEvidence evidence = pair_evidence(pair);
  if (evidence.inliers < least_inliers) return "shows another scene, or too little to tell";
  const std::optional<DisparityRange> range = find_disparity_range(pair);
  constexpr int least_depth = 100;  // of the width
  if (!range || (range->largest - range->least) * least_depth < size.width) return "shows no depth";
  const EyeOrder eyes = eye_order(pair);
  if (eyes == EyeOrder::undecided) return "does not tell left from right";
  is_swapped = eyes == EyeOrder::swapped;
  return {};
}

}  // namespace

PairsByTime pairs_by_time(const std::vector<fs::path>& files, const Progress& progress) {
  PairsByTime found;
  std::vector<Taken> taken;
  for (const fs::path& file : files) {
    if (const std::optional<double> time_s = time_of(file))
      taken.push_back({*time_s, file});
    else
      found.left_out.push_back({file, alone, {}});
  }
  std::ranges::sort(
      taken, [](const Taken& a, const Taken& b) { return std::tie(a.time_s, a.file) < std::tie(b.time_s, b.file); });
  for (std::size_t begin = 0, end = 0; begin < taken.size(); begin = end) {
    end = begin + 1;
    while (end < taken.size() && taken[end].time_s - taken[end - 1].time_s <= together_s) ++end;
    const std::size_t count = end - begin;
    if (count != 2) {
      for (std::size_t i = begin; i < end; ++i)
        found.left_out.push_back(
            {taken[i].file,
             count == 1 ? alone : fmt::format("doubtful partner: {} pictures were taken within seconds", count),
             {}});
      continue;
    }
    std::array<fs::path, 2> pair{taken[begin].file, taken[begin + 1].file};
    report(progress, fmt::format("looking at {}", pair[0].string()),
           static_cast<double>(begin) / static_cast<double>(taken.size()));
    bool is_swapped = false;
    const std::string wrong = wrong_with({read_image(pair[0]), read_image(pair[1])}, is_swapped);
    if (is_swapped) std::swap(pair[0], pair[1]);
    const std::string other = pair[1].filename().string();
    if (wrong.empty()) {
      found.photographs.push_back({.stem = {},
                                   .left = pair[0],
                                   .right = pair[1],
                                   .depth = {},
                                   .why = fmt::format("pair with {}, by their time and what they show", other)});
      continue;
    }
    for (const std::size_t i : {0U, 1U})
      found.left_out.push_back({pair[i],
                                fmt::format("doubtful partner: {} was taken at the same time, but {}",
                                            pair[1 - i].filename().string(), wrong),
                                {}});
  }
  return found;
}

}  // namespace wheatstone
