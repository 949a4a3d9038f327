#include "depth_seen.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <memory>
#include <variant>

#include "inputs.h"
#include "orbit.h"
#include "output_mode.h"
#include "viewer.h"
#include "wheatstone/depth/comfort.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/marks/mapped_depth.h"
#include "wheatstone/multiview/render_slices.h"

namespace wheatstone::viewer {
namespace {

/// Millimetres on the display's screen for a pixel of what is shown. A display with many views shows the picture as
/// wide as its screen.
float mm_a_pixel(const Frame& frame, const ViewState& state) {
  const DisplayPreset& display = find_display(state.display);
  if (shows_display_views(find_output_mode(state.mode)))
    return display.screen_width_mm / static_cast<float>(std::max(size_of(frame.shown).width, 1));
  if (orbited(frame.shown) && !frame.places.empty())
    return display.screen_width_mm / static_cast<float>(std::max(frame.places.front().width, 1));
  const int screen_px = display.lenses.screen_width_px > 0 ? display.lenses.screen_width_px : display.view_width_px;
  return static_cast<float>(frame.scale) * display.screen_width_mm / static_cast<float>(screen_px);
}

/// How far behind the screen a disparity is seen.
float behind_mm(const Frame& frame, const ViewState& state, float disparity_px) {
  const Adjustment& adjustment = state.adjustment;
  const float parallax_px = (adjustment.zero_parallax_px - disparity_px) * adjustment.separation;
  return perceived_depth_mm(viewing_of(find_display(state.display)), parallax_px * mm_a_pixel(frame, state));
}

/// The whole scene is where its regions have it, though what is open is as it was.
bool is_placed_as_drawn(const Frame& frame, const ViewState& state) {
  return !state.depth_regions.empty() && (orbited(frame.shown) || shows_display_views(find_output_mode(state.mode)));
}

std::string side_of_screen(float behind) {
  return fmt::format("{:.0f} mm {}", std::abs(behind), behind < 0 ? "in front" : "behind");
}

}  // namespace

DepthPlacing placing_of(const ViewState& state) {
  return {state.depth_regions, viewing_of(find_display(state.display))};
}

Content placed_content(const Content& content, const ViewState& state) {
  if (state.depth_regions.empty()) return content;
  DepthPlacing placing = placing_of(state);
  if (const auto* const painted = std::get_if<PaintedContent>(&content);
      painted && painted->painting && !shows_display_views(find_output_mode(state.mode))) {
    PaintedContent placed = *painted;
    placed.painting =
        std::make_shared<const Painting>(place_depth(*painted->painting, placing, width_of(*painted->painting)));
    return placed;
  }
  if (const auto* const sliced = std::get_if<SlicesContent>(&content)) {
    auto placed = std::make_shared<SliceStack>(*sliced->slices);
    map_depth(*placed, placing.regions, placing.viewing);
    return SlicesContent{std::move(placed)};
  }
  return content;
}

bool can_bend(const Content& content) {
  const auto* const painted = std::get_if<PaintedContent>(&content);
  return painted && painted->painting && !std::holds_alternative<RegionPainting>(painted->painting->marks);
}

Content bent_content(const Content& content, const ViewState& state) {
  if (!state.depth_around || !can_bend(content) || shows_display_views(find_output_mode(state.mode))) return content;
  PaintedContent bent = std::get<PaintedContent>(content);
  bent.painting = std::make_shared<const Painting>(with_depth_around(*bent.painting, *state.depth_around));
  return bent;
}

std::optional<DepthSeen> depth_seen(const Viewer& viewer) {
  const Frame* const frame = viewer.frame();
  if (frame == nullptr) return {};
  const std::optional<DepthEnds>& depth = frame->depth;
  const ViewState& state = viewer.session().state;
  const ViewingGeometry viewing = viewing_of(find_display(state.display));
  DepthSeen seen;
  if (is_placed_as_drawn(*frame, state)) {
    seen.near_mm = -state.depth_regions.front().behind_mm;
    seen.far_mm = state.depth_regions.back().behind_mm;
  } else if (depth) {
    seen.near_mm = -behind_mm(*frame, state, depth->nearest_px);
    seen.far_mm = behind_mm(*frame, state, depth->farthest_px);
  } else {
    return {};
  }
  seen.total_percent = total_parallax_percent(viewing, seen.near_mm, seen.far_mm);
  seen.discomforts = discomforts(viewing, seen.near_mm, seen.far_mm);
  return seen;
}

ComfortableDepth comfortable_depth(const ViewingGeometry& viewing) {
  const auto largest = [](float beyond_mm, auto is_comfortable) {
    float least_mm = 0;
    for (int step = 0; step < 24; ++step) {
      const float middle_mm = (least_mm + beyond_mm) / 2;
      (is_comfortable(middle_mm) ? least_mm : beyond_mm) = middle_mm;
    }
    return least_mm;
  };
  const float farthest_mm = 100 * viewing.viewing_distance_mm;
  return {largest(viewing.viewing_distance_mm, [&](float mm) { return discomforts(viewing, mm, 0).empty(); }),
          largest(farthest_mm, [&](float mm) { return discomforts(viewing, 0, mm).empty(); })};
}

std::string comfort_told(const Viewer& viewer) {
  const std::optional<DepthSeen> seen = depth_seen(viewer);
  if (!seen) return "the depth is not known";
  const std::string& display = viewer.session().state.display;
  if (!seen->discomforts.empty())
    return fmt::format("not comfortable on {}: {}", display, fmt::join(seen->discomforts, "; "));
  return fmt::format("comfortable on {}: from {} to {}, parallax {:.1f} % of the width", display,
                     side_of_screen(-seen->near_mm), side_of_screen(seen->far_mm), seen->total_percent);
}

std::string comfort_in_short(const Viewer& viewer) {
  const std::optional<DepthSeen> seen = depth_seen(viewer);
  if (!seen) return {};
  return fmt::format("{:.0f} to {:.0f} mm, {:.1f} %: {}", std::round(-seen->near_mm) + 0.f,
                     std::round(seen->far_mm) + 0.f, seen->total_percent,
                     seen->discomforts.empty() ? "comfortable" : "not comfortable");
}

std::string depth_told(const Viewer& viewer, double x, double y) {
  const Frame* const frame = viewer.frame();
  if (frame == nullptr) return {};
  const std::optional<float> disparity = disparity_under(viewer, x, y);
  if (!disparity) return {};
  return fmt::format("{:.1f} px, {}", *disparity,
                     side_of_screen(behind_mm(*frame, viewer.session().state, *disparity)));
}

}  // namespace wheatstone::viewer
