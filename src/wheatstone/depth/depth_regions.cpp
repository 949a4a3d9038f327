#include "wheatstone/depth/depth_regions.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "wheatstone/error.h"

namespace wheatstone {
namespace {

constexpr float farthest_mm = 1e9f;

[[noreturn]] void refuse(const std::string& name, std::string_view text) {
  throw Error(
      ErrorKind::wrong_usage,
      fmt::format("{}: is '{}', expected SHARE:MM pairs in ascending order, as 0:-80,0.4:0,1:80, shares from 0 to 1",
                  name, text));
}

}  // namespace

std::vector<DepthRegion> parse_depth_regions(std::string_view text, const std::string& name) {
  std::vector<DepthRegion> regions;
  const char* at = text.data();
  const char* const end = at + text.size();
  // A number and what must stand behind it; the last pair ends with the text.
  const auto number_before = [&](char behind) {
    float number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    const bool at_end = stop == end && behind == ',';
    if (error != std::errc{} || !std::isfinite(number) || !(at_end || (stop != end && *stop == behind)))
      refuse(name, text);
    at = at_end ? end : stop + 1;
    if (!at_end && at == end) refuse(name, text);
    return number;
  };
  while (at != end) {
    const float share = number_before(':');
    regions.push_back({share, number_before(',')});
  }
  check_depth_regions(regions, name);
  return regions;
}

std::string text_of(std::span<const DepthRegion> regions) {
  std::string text;
  for (const DepthRegion& region : regions)
    text += fmt::format("{}{}:{}", text.empty() ? "" : ",", region.share, region.behind_mm);
  return text;
}

void check_depth_regions(std::span<const DepthRegion> regions, const std::string& name) {
  if (regions.empty()) refuse(name, "");
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const DepthRegion& region = regions[i];
    const bool rises = i == 0 || (region.share > regions[i - 1].share && region.behind_mm >= regions[i - 1].behind_mm);
    if (!rises || !(region.share >= 0 && region.share <= 1) || !(std::abs(region.behind_mm) <= farthest_mm))
      refuse(name, text_of(regions));
  }
}

}  // namespace wheatstone
