#include "wheatstone/depth/comfort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wheatstone {
namespace {

constexpr float desk_mm = 1000;
constexpr float desk_limit_mm = 100;
constexpr float degrees = 1;
constexpr float broadcast_before_percent = 1;
constexpr float broadcast_behind_percent = 2;
static_assert(broadcast_before_percent + broadcast_behind_percent == 100 * comfortable_parallax_share);
constexpr float adults_mm = 65;
/// Limits hold to the last digit that a user types, not to the last bit.
constexpr float tolerance = 1.0001f;

}  // namespace

float total_parallax_percent(const ViewingGeometry& viewing, float near_mm, float far_mm) {
  return 100 * (screen_parallax_mm(viewing, far_mm) - screen_parallax_mm(viewing, -near_mm)) / viewing.screen_width_mm;
}

std::vector<std::string> discomforts(const ViewingGeometry& viewing, float near_mm, float far_mm) {
  std::vector<std::string> found;
  if (near_mm >= viewing.viewing_distance_mm)
    return {
        fmt::format("the nearest point, {:.0f} mm in front of the screen, is behind the viewer, who is {:.0f} mm away",
                    near_mm, viewing.viewing_distance_mm)};

  const float before_percent = -100 * screen_parallax_mm(viewing, -near_mm) / viewing.screen_width_mm;
  const float behind_percent = 100 * screen_parallax_mm(viewing, far_mm) / viewing.screen_width_mm;
  if (viewing.viewing_distance_mm <= desk_mm) {
    if (std::max(near_mm, far_mm) > desk_limit_mm * tolerance)
      found.push_back(fmt::format(
          "a depth of {:.0f} mm in front of and {:.0f} mm behind the screen is more than the {:.0f} mm that are "
          "comfortable on a desk",
          near_mm, far_mm, desk_limit_mm));
  } else if (before_percent > broadcast_before_percent * tolerance ||
             behind_percent > broadcast_behind_percent * tolerance) {
    found.push_back(fmt::format(
        "a parallax of {:.1f} % of the width in front of and {:.1f} % behind the screen, {:.1f} % in all, is more "
        "than the {:.0f} % and {:.0f} % that broadcasters allow",
        before_percent, behind_percent, before_percent + behind_percent, broadcast_before_percent,
        broadcast_behind_percent));
  }

  const float before = angular_disparity_deg(viewing, -near_mm);
  const float behind = -angular_disparity_deg(viewing, far_mm);
  if (std::max(before, behind) > degrees * tolerance)
    found.push_back(fmt::format(
        "an angular disparity of {:.2f} degrees in front of and {:.2f} behind the screen is more than the {:.0f} "
        "degree that is comfortable",
        before, behind, degrees));

  const float width = screen_parallax_mm(viewing, far_mm);
  if (width > adults_mm * tolerance)
    found.push_back(fmt::format(
        "a parallax of {:.0f} mm behind the screen is larger than the eye separation ({:.0f} mm)", width, adults_mm));
  return found;
}

}  // namespace wheatstone
