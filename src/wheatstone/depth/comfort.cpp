#include "wheatstone/depth/comfort.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wheatstone {

float angular_disparity_deg(const ViewingGeometry& viewing, float behind_mm) {
  const auto vergence = [&](float distance_mm) { return 2 * std::atan(viewing.eye_separation_mm / (2 * distance_mm)); };
  const float radians = vergence(viewing.viewing_distance_mm + behind_mm) - vergence(viewing.viewing_distance_mm);
  return radians * 180 / std::numbers::pi_v<float>;
}

std::vector<std::string> discomforts(const ViewingGeometry& viewing, float near_mm, float far_mm) {
  constexpr float desk_mm = 1000;
  constexpr float desk_limit_mm = 100;
  constexpr float degrees = 1;
  std::vector<std::string> found;
  const float farthest = std::max(near_mm, far_mm);
  if (viewing.viewing_distance_mm <= desk_mm && farthest > desk_limit_mm)
    found.push_back(
        fmt::format("depth of {:.0f} mm before and {:.0f} mm behind the screen is more than the {:.0f} mm that are "
                    "comfortable on a desk",
                    near_mm, far_mm, desk_limit_mm));
  const float before = angular_disparity_deg(viewing, -near_mm);
  const float behind = -angular_disparity_deg(viewing, far_mm);
  if (std::max(before, behind) > degrees)
    found.push_back(
        fmt::format("angular disparity of {:.2f} degrees before and {:.2f} behind the screen is more than the {:.0f} "
                    "degree that is comfortable",
                    before, behind, degrees));
  const float width = screen_parallax_mm(viewing, far_mm);
  constexpr float adults_mm = 65;
  if (width > adults_mm)
    found.push_back(fmt::format("parallax of {:.0f} mm behind the screen is wider than eyes are apart ({:.0f} mm)",
                                width, adults_mm));
  return found;
}

}  // namespace wheatstone
