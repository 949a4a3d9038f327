#include "depth_placing.h"

#include <memory>
#include <variant>

#include "output_mode.h"
#include "wheatstone/depth/disparity_mapping.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/marks/mapped_depth.h"

namespace wheatstone::viewer {

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
    const DepthEnds depth = depth_of(content).value_or(DepthEnds());
    placing.viewing.width_px = placed->width;
    const DisparityMapping mapping = disparity_mapping(placing.regions, depth, placing.viewing);
    for (Slice& slice : placed->slices) slice.parallax_px = -mapped_px(mapping, -slice.parallax_px);
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

}  // namespace wheatstone::viewer
