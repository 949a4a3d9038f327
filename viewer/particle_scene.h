#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "compose.h"
#include "content.h"
#include "view_state.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone::viewer {

class Viewer;

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

/// How well something is drawn.
enum class Effort {
  quick,  ///< within a tenth of a second or so: for what moves
  whole,
};

struct DrawnParticles {
  std::vector<Image<Rgb8>> views;
  Brightness brightness;  ///< that all particles were given
  bool of_all = true;     ///< false: of a share of them, or not of the quantity that is to be shown
};

/// Draws views of particles: quickly, every nth particle with n times its light, or all of them. Keeps every nth
/// particle, and how long particles take. Of one thread.
class ParticleDrawer {
 public:
  /// Throws as render, and as particle_scene.
  DrawnParticles draw(const std::shared_ptr<const Particles>& particles, const ViewState& state, const Rig& rig,
                      Effort effort);
  /// What is taken of the machine until it is measured, with every drawing.
  void expect_seconds_a_particle(double seconds) { seconds_a_particle_ = seconds; }

 private:
  std::size_t share_for(std::size_t particles) const;
  const ReadyParticles& thinned(const std::shared_ptr<const Particles>& particles, std::size_t every);

  std::shared_ptr<const Particles> of_;
  std::size_t every_ = 1;
  ReadyParticles thinned_;
  double seconds_a_particle_ = 2e-7;
};

/// The particles that are open; none where something else is.
const Particles* open_particles(const Viewer& viewer);

/// The views that a viewer's two eyes are shown.
Rig eyes_of(const Viewer& viewer);

/// Moves what is seen of particles by so many pixels of an eye's picture. Does nothing, and returns false, where
/// something else is open.
bool pan_particles(Viewer& viewer, double x_px, double y_px);

/// Magnifies particles so many times more; what lies so far from the middle of an eye's picture stays there.
bool magnify_particles(Viewer& viewer, double factor, double x_px = 0, double y_px = 0);

/// Shows particles as when they were opened.
bool fit_particles(Viewer& viewer);

}  // namespace wheatstone::viewer
