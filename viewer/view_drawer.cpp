#include "view_drawer.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "depth_seen.h"
#include "output_mode.h"
#include "particle_scene.h"
#include "wheatstone/app/display_views.h"
#include "wheatstone/depth/display_presets.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/display/disparity_picture.h"
#include "wheatstone/error.h"
#include "wheatstone/multiview/render_slices.h"
#include "wheatstone/stereo/picture_sizes.h"

namespace wheatstone::viewer {
namespace {

/// The pictures nearest to the positions, of those that stand evenly over `span`; reduced where they are shown smaller.
DrawnViews nearest_pictures(std::span<const ImageView<const Rgb8>> pictures, float span, const WantedPart& part,
                            const std::vector<ViewPosition>& wanted) {
  const std::vector<ViewPosition> at = evenly_spaced(0, 0, static_cast<int>(pictures.size()), span).positions;
  DrawnViews drawn;
  drawn.scale = std::min(part.scale, 1.);
  for (const ViewPosition position : wanted) {
    const auto nearest = std::ranges::min_element(at, {}, [&](ViewPosition here) { return std::abs(here - position); });
    const ImageView<const Rgb8>& picture = pictures[static_cast<std::size_t>(nearest - at.begin())];
    drawn.positions.push_back(*nearest);
    const PictureSize size{std::max(static_cast<int>(std::lround(picture.width() * drawn.scale)), 1),
                           std::max(static_cast<int>(std::lround(picture.height() * drawn.scale)), 1)};
    drawn.pictures.push_back(reduced(picture, size));
  }
  return drawn;
}

DrawnViews photographs(const StereoPair& pair, const WantedPart& part, const std::vector<ViewPosition>& wanted) {
  std::vector<ImageView<const Rgb8>> pictures{pair.left};
  if (!pair.right.empty()) pictures.emplace_back(pair.right);
  return nearest_pictures(pictures, 1, part, wanted);
}

StereoPair under_its_depth(const Photograph& photograph) {
  const StereoGeometry& geometry = *photograph.geometry;
  return {disparity_over(photograph.pictures.left, geometry.left_disparity, geometry.left_disparity),
          disparity_over(pictures_to_paint(photograph).right, geometry.right_disparity, geometry.left_disparity)};
}

std::vector<Image<Rgb8>> slice_views(const SliceStack& stack, const std::vector<ViewPosition>& positions,
                                     const ViewState& state) {
  return render_slices(stack, {stack.width, stack.height, positions}, SliceFilter::centroid, {},
                       focus_in(state.look.focus, stack.width, stack.height));
}

}  // namespace

ViewDrawer::Placing ViewDrawer::placing_of(const Content& content, const ViewState& state) {
  if (is_scene(content)) return {state.orbit, state.look, state.display, state.depth_regions};
  Placing placing;
  placing.regions = state.depth_regions;
  return placing;
}

const SliceStack& ViewDrawer::placed_slices(const SlicesContent& content, const ViewState& state) {
  const bool has_ends = state.look.near_mm || state.look.far_mm;
  if (!has_ends || !state.depth_regions.empty()) return *content.slices;
  Placing placing;
  placing.look.near_mm = state.look.near_mm;
  placing.look.far_mm = state.look.far_mm;
  placing.display = state.display;
  if (!placed_slices_ || placed_slices_->content != content || placed_slices_->placing != placing) {
    placed_slices_.reset();
    placed_slices_ = PlacedSlices{content, placing, *content.slices};
    const DepthMapping mapping = mapping_for(perceived_depth(state), content.slices->width, 1, 2);
    map_depth(placed_slices_->slices, mapping.points.front().parallax_px, mapping.points.back().parallax_px);
  }
  return placed_slices_->slices;
}

DrawnViews ViewDrawer::draw_painting(const std::shared_ptr<const Painting>& painting, const Slicing& slicing,
                                     const WantedPart& part, const std::vector<ViewPosition>& positions) {
  DrawnViews drawn{.positions = positions, .scale = part.scale, .left = part.left, .top = part.top};
  const auto draw_all = [&](const PreparedPainting& ready) {
    for (DrawnView& view : draw(ready, positions)) drawn.pictures.push_back(std::move(view.picture));
  };
  if (prepared_ && (prepared_->part != part || prepared_->slicing != slicing)) prepared_.reset();
  if (prepared_ && prepared_->painting == painting) {
    draw_all(prepared_->ready);
    return drawn;
  }
  if (prepared_ && !(shows_prepared(positions) && is_drawn_by_processor(prepared_->ready))) prepared_.reset();
  const bool as_it_is = part == WantedPart{1, 0, 0, width_of(*painting), height_of(*painting)};
  const Placement placement = as_it_is ? Placement{}
                                       : Placement{.width = part.width,
                                                   .height = part.height,
                                                   .scale = part.scale,
                                                   .left = part.left / part.scale,
                                                   .top = part.top / part.scale};
  PreparedPainting ready = prepare(*painting, {.placement = placement, .slicing = slicing}, Device::automatic);
  if (prepared_) {  // a hand changes little of a painting
    drawn.pictures = drawn_->views.pictures;
    draw_again(ready, prepared_->ready, positions, drawn.pictures);
  } else {
    draw_all(ready);
  }
  prepared_ = Prepared{painting, part, slicing, std::move(ready)};
  return drawn;
}

bool ViewDrawer::shows_prepared(const std::vector<ViewPosition>& positions) const {
  const auto* const painted = drawn_ ? std::get_if<PaintedContent>(&drawn_->content) : nullptr;
  return painted != nullptr && painted->painting == prepared_->painting && drawn_->part == prepared_->part &&
         drawn_->slicing == prepared_->slicing && drawn_->wanted == positions;
}

const Content& ViewDrawer::placed(const Content& content, const ViewState& state) {
  if (state.depth_regions.empty()) {
    placed_.reset();
    return content;
  }
  const bool for_display = shows_display_views(find_output_mode(state.mode));
  if (!placed_ || placed_->content != content || placed_->regions != state.depth_regions ||
      placed_->display != state.display || placed_->for_display != for_display)
    placed_ = Placed{content, state.depth_regions, state.display, for_display, placed_content(content, state)};
  return placed_->placed;
}

const Content& ViewDrawer::bent(const Content& content, const ViewState& state) {
  if (!state.depth_around) {
    bent_.reset();
    return content;
  }
  const bool for_display = shows_display_views(find_output_mode(state.mode));
  if (!bent_ || bent_->content != content || bent_->around != *state.depth_around || bent_->for_display != for_display)
    bent_ = Bent{content, *state.depth_around, for_display, bent_content(content, state)};
  return bent_->bent;
}

const DrawnViews& ViewDrawer::painted(const Content& content, const ViewState& state, const WantedPart& part,
                                      const std::vector<ViewPosition>& positions, Effort effort) {
  Placing placing = placing_of(content, state);
  const bool good_enough = drawn_ && (effort == Effort::quick || !drawn_->views.preliminary);
  if (good_enough && drawn_->content == content && drawn_->part == part && drawn_->wanted == positions &&
      drawn_->slicing == state.slicing && drawn_->placing == placing)
    return drawn_->views;
  DrawnViews views;
  if (const auto* const painted = std::get_if<PaintedContent>(&content)) {
    views = painted->painting ? draw_painting(painted->painting, state.slicing, part, positions)
                              : photographs(painted->photograph->pictures, part, positions);
  } else if (const auto* const pictures = std::get_if<ViewsContent>(&content)) {
    const std::vector<ImageView<const Rgb8>> lent(pictures->views->begin(), pictures->views->end());
    views = nearest_pictures(lent, pictures->span, part, positions);
  } else if (const auto* const slices = std::get_if<SlicesContent>(&content)) {
    views = {.pictures = slice_views(placed_slices(*slices, state), positions, state), .positions = positions};
  } else if (const auto* const particles = std::get_if<ParticlesContent>(&content)) {
    DrawnParticles made = particles_.draw(particles->particles, state, {part.width, part.height, positions}, effort);
    views = {.pictures = std::move(made.views),
             .positions = positions,
             .preliminary = !made.of_all,
             .brightness = made.brightness};
    // The state will say what was found.
    if (made.of_all) keep_brightness(placing.look, made.brightness);
  } else if (const auto* const model = std::get_if<ModelContent>(&content)) {
    DrawnModel made = models_.draw(*model->model, state, {part.width, part.height, positions}, effort);
    views = {.pictures = std::move(made.views),
             .positions = positions,
             .scale = made.scale,
             .preliminary = made.scale < 1,
             .depth = std::move(made.depth)};
  }
  drawn_ = Drawn{content, part, state.slicing, std::move(placing), positions, std::move(views)};
  return drawn_->views;
}

const DrawnViews* ViewDrawer::photographed(const Content& content, const WantedPart& part,
                                           const std::vector<ViewPosition>& positions, bool with_depth) {
  const auto* const painted = std::get_if<PaintedContent>(&content);
  if (painted == nullptr || !painted->photograph) return nullptr;
  if (!photographed_ || photographed_->content != content || photographed_->part.scale != part.scale ||
      photographed_->wanted != positions || photographed_with_depth_ != with_depth) {
    const Photograph& photograph = *painted->photograph;
    DrawnViews views = with_depth && photograph.geometry ? photographs(under_its_depth(photograph), part, positions)
                                                         : photographs(photograph.pictures, part, positions);
    photographed_with_depth_ = with_depth;
    photographed_ = Drawn{content, part, Slicing(), Placing(), positions, std::move(views)};
  }
  return &photographed_->views;
}

const std::vector<Image<Rgb8>>& ViewDrawer::display_views(const Content& content, const ViewState& state) {
  const float zero_parallax_px = state.adjustment.zero_parallax_px;
  const Placing placing = placing_of(content, state);
  if (display_ && display_->content == content && display_->display == state.display &&
      display_->zero_parallax_px == zero_parallax_px && display_->placing == placing)
    return display_->views;
  const DisplayPreset& display = find_display(state.display);
  std::vector<Image<Rgb8>> views;
  DisplayViewsOptions options = views_of_display(display);
  const Rig rig = evenly_spaced(options.width, options.height, options.views, options.widest_span);
  if (const auto* const painted = std::get_if<PaintedContent>(&content)) {
    if (!painted->painting) throw Error(ErrorKind::bad_input, "the photograph is not painted yet");
    options.zero_parallax_px = zero_parallax_px;
    options.depth = viewer::placing_of(state);
    views = draw_display_views(*painted->painting, options).shown.views;
  } else if (const auto* const pictures = std::get_if<ViewsContent>(&content)) {
    views = *pictures->views;
  } else if (const auto* const slices = std::get_if<SlicesContent>(&content)) {
    views = slice_views(placed_slices(*slices, state), rig.positions, state);
  } else if (const auto* const particles = std::get_if<ParticlesContent>(&content)) {
    views = particles_.draw(particles->particles, state, rig, Effort::whole).views;
  } else if (const auto* const model = std::get_if<ModelContent>(&content)) {
    views = models_.draw(*model->model, state, rig, Effort::whole).views;
  }
  display_ = DisplayDrawn{content, state.display, zero_parallax_px, placing, std::move(views)};
  return display_->views;
}

}  // namespace wheatstone::viewer
