#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wheatstone {

/// A place between a scene's nearest point, share 0, and its farthest, 1, and how far behind the screen it is to seem;
/// negative before it. Several make regions, one between each two neighbours (Hassaine 2010, sec. 6.1).
struct DepthRegion {
  float share = 0;
  float behind_mm = 0;
  friend bool operator==(const DepthRegion&, const DepthRegion&) = default;
};

/// "0:-80,0.4:0,1:80". Throws Error{wrong_usage}, beginning with `name`, for any other text, and as
/// check_depth_regions does.
std::vector<DepthRegion> parse_depth_regions(std::string_view text, const std::string& name);

/// The text that parse_depth_regions reads as these.
std::string text_of(std::span<const DepthRegion> regions);

/// Throws Error{wrong_usage}, beginning with `name`, where there are none, where shares are not from 0 to 1 or do not
/// ascend, or where depths descend.
void check_depth_regions(std::span<const DepthRegion> regions, const std::string& name);

}  // namespace wheatstone
