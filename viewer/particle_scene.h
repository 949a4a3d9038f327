#pragma once

#include <array>
#include <memory>
#include <optional>
#include <vector>

#include "compose.h"
#include "content.h"
#include "orbit.h"
#include "view_state.h"
#include "wheatstone/app/render_particles.h"
#include "wheatstone/depth/rig.h"
#include "wheatstone/multiview/scene.h"

namespace wheatstone::viewer {

class Viewer;

/// Puts what is read into options. Throws Error{wrong_usage} where a text makes no sense.
void put_choice(const ParticleChoice& choice, RenderParticlesOptions& options);

/// Whether the same numbers are read for both: the mean of a quantity has its name.
bool reads_the_same(const ParticleChoice& a, const ParticleChoice& b);

/// How deep a state has particles, or slices, stand on its display.
PerceivedDepth perceived_depth(const ViewState& state);

/// The options of `wheatstone render` that make the views of a rig as a state has them. Throws Error{wrong_usage} where
/// these make no sense.
RenderParticlesOptions render_options(const ViewState& state, const Rig& rig);

/// A state's focus in views of this size; none where it has none.
std::optional<Focus> focus_in(const ScreenFocus& focus, int width, int height);

/// Whether there can be more depth in an area of the views: of particles and slices.
bool has_focus(const Content& content);

/// The size of a view of what is open, in its own pixels.
PictureSize size_of_view(const Viewer& viewer);

/// Throws Error{wrong_usage} where a focus would fold the views of the particles that are open.
void check_focus_in(const Viewer& viewer, const ScreenFocus& focus);

/// What the views of a rig see of particles, as `wheatstone render` has it with the options of the state. Throws
/// Error{wrong_usage} where these make no sense.
Scene particle_scene(const Particles& particles, const ViewState& state, const Rig& rig);

/// What is seen at a place of a view of particles: the nearest of those that shine the brightest there. None where no
/// particle is near the place. Of very many particles only some are looked at.
std::optional<SeenPoint> particle_at(const Particles& particles, const Scene& scene, const PlaceInView& place);

/// How well something is drawn.
enum class Effort {
  quick,  ///< within quick_s or so: for what moves
  whole,
};
constexpr double quick_s = 0.1;

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

}  // namespace wheatstone::viewer
