#pragma once

#include <array>
#include <optional>

#include "content.h"
#include "frame_geometry.h"
#include "view_state.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone::viewer {

/// How deep a state has particles, or slices, stand on its display.
PerceivedDepth perceived_depth(const ViewState& state);

/// The options of `wheatstone render` that make the views of a rig as a state has them. Throws Error{wrong_usage} where
/// these make no sense.
RenderParticlesOptions render_options(const ViewState& state, const Rig& rig);

/// A state's focus in views of this size; none where it has none.
std::optional<Focus> focus_in(const ScreenFocus& focus, int width, int height);

/// What the views of a rig see of particles, as `wheatstone render` has it with the options of the state. Throws
/// Error{wrong_usage} where these make no sense.
Scene particle_scene(const Particles& particles, const ViewState& state, const Rig& rig);

/// What is seen at a place of a view of particles: the nearest of those that shine the brightest there.
struct SeenParticle {
  std::array<float, 3> position{};  ///< on the line of sight through the place
  float parallax_px = 0;            ///< on the screen, of a view at full eye separation
};
/// None where no particle is near the place. Of very many particles only some are looked at.
std::optional<SeenParticle> particle_at(const Particles& particles, const Scene& scene, const PlaceInView& place);

/// The framing's point in the middle of the views, moved so that what the central view shows moves by so many pixels.
/// `rig` says how large the views are.
std::array<float, 3> moved_look_at(const Particles& particles, const ViewState& state, const Rig& rig, double x_px,
                                   double y_px);

}  // namespace wheatstone::viewer
